#pragma once

#include <span>
#include <vector>

#include "amble/io/binary.hpp"
#include "amble/neat/genome.hpp"

namespace amble::neat {

/// The genome as bytes, weights to the bit.
void save(const Genome& genome, io::BinaryWriter& writer);
/// Reads what save() wrote; throws UserError(ExitCode::bad_file). validate() checks whether the genes are
/// consistent.
Genome load_genome(io::BinaryReader& reader);

/// Several genomes, their number first.
void save(std::span<const Genome> genomes, io::BinaryWriter& writer);
/// Reads what save() wrote of several; throws as load_genome().
std::vector<Genome> load_genomes(io::BinaryReader& reader);

}  // namespace amble::neat
