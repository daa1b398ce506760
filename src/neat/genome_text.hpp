#pragma once

#include <string>

#include "amble/neat/genome.hpp"

namespace amble::neat {

/// A genome as JSON, as champion files have it (docs/FORMATS.md). Weights read back to the same bits.
std::string genome_text(const Genome& genome);

/// What genome_text() wrote. `what` names the text in errors. Throws UserError(ExitCode::bad_file): no JSON,
/// a missing or wrong key. validate() checks whether the genes are consistent.
Genome parse_genome(const std::string& text, const std::string& what);

}  // namespace amble::neat
