#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "amble/search/distance_estimates.hpp"

namespace amble::search {

/// Somebody who may be among the nearest.
struct Candidate {
  Bounds squared_distance;
  std::span<const float> behaviour;
};

/// Exact squared distances from `from` to the `count` nearest of the candidates, ascending; fewer if there
/// are fewer. The bounds only save work: whatever they are, as long as they hold, the result is the same to
/// the bit.
std::vector<double> nearest_squared_distances(std::span<const float> from,
                                              std::span<const Candidate> candidates, std::size_t count);

}  // namespace amble::search
