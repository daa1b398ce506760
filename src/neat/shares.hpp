#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "amble/core/random.hpp"

namespace amble::neat {

/// Divides `total` places among species in proportion to `shares` (finite, ≥ 0, of any size; all equal if all
/// are zero) by the method of the largest remainder, equal remainders by index: the sum is exactly `total`.
/// Species `kept`, if any, gets at least one place, if need be from the species that got most.
std::vector<int> allot_places(std::span<const double> shares, int total, std::optional<std::size_t> kept);

/// An index drawn with probability in proportion to its weight. Weights are finite and ≥ 0, of any size; if
/// all are zero, every index is equally likely. At least one weight. Takes one draw from the stream.
std::size_t roulette(std::span<const double> weights, Stream& stream);

}  // namespace amble::neat
