#pragma once

#include <string>
#include <string_view>

#include "amble/neat/genome.hpp"

namespace amble::neat {

/// The genome as a few bytes, weights to the bit, for archives of up to millions in memory: about 11 bytes a
/// link and 3 a hidden node, a fifth of a Genome. Numbers are variable in length (7 bits a byte), innovation
/// numbers and ids of hidden nodes are differences to the one before.
std::string compact(const Genome& genome);

/// Reads what compact() wrote; throws UserError(ExitCode::bad_file) naming `what`. validate() checks whether
/// the genes are consistent.
Genome expand(std::string_view bytes, const std::string& what);

}  // namespace amble::neat
