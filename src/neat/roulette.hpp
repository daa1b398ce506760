#pragma once

#include <cstddef>
#include <span>

#include "amble/core/random.hpp"

namespace amble::neat {

/// An index drawn with probability in proportion to its weight. Weights are finite and ≥ 0, of any size; if
/// all are zero, every index is equally likely. At least one weight. Takes one draw from the stream.
std::size_t roulette(std::span<const double> weights, Stream& stream);

}  // namespace amble::neat
