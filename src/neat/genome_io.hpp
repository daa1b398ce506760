#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "amble/io/binary.hpp"
#include "amble/neat/genome.hpp"

namespace amble::neat {

/// A genome as JSON, as champion files have it (docs/FORMATS.md). Weights read back to the same bits.
std::string genome_text(const Genome& genome);

/// What genome_text() wrote. `what` names the text in errors. Throws UserError(ExitCode::bad_file): no JSON,
/// a missing or wrong key. validate() checks whether the genes are consistent.
Genome parse_genome(const std::string& text, const std::string& what);

/// The genome as bytes, weights to the bit.
void save(const Genome& genome, io::BinaryWriter& writer);
/// Reads what save() wrote; throws UserError(ExitCode::bad_file). validate() checks whether the genes are
/// consistent.
Genome load_genome(io::BinaryReader& reader);

/// Several genomes, their number first.
void save(std::span<const Genome> genomes, io::BinaryWriter& writer);
/// Reads what save() wrote of several; throws as load_genome().
std::vector<Genome> load_genomes(io::BinaryReader& reader);

/// The genome as a few bytes, weights to the bit, for archives of up to millions in memory: about 11 bytes a
/// link and 3 a hidden node, a fifth of a Genome. Numbers are variable in length (7 bits a byte), innovation
/// numbers and ids of hidden nodes are differences to the one before.
std::string compact(const Genome& genome);

/// Reads what compact() wrote; throws UserError(ExitCode::bad_file) naming `what`. validate() checks whether
/// the genes are consistent.
Genome expand(std::string_view bytes, const std::string& what);

}  // namespace amble::neat
