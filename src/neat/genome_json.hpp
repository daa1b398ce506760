#pragma once

#include "amble/io/json_file.hpp"
#include "amble/neat/genome.hpp"

namespace amble::neat {

/// {"nodes": [{"id", "kind", "activation"}, …], "links": [{"innovation", "from", "to", "weight", "enabled"},
/// …]}, kinds and activations by name, both lists in the order of the genome.
io::Json to_json(const Genome& genome);

/// Reads what to_json wrote. Throws UserError (ExitCode::bad_file) naming the key: missing, of the wrong
/// type, a number that is not finite or out of range, an unknown name. validate() checks whether the genes
/// are consistent.
Genome genome_from_json(const io::JsonView& json);

}  // namespace amble::neat
