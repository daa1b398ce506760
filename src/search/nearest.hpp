#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "amble/search/distance_estimates.hpp"

namespace amble::search {

/// A behaviour that may be among the nearest, with bounds on its distance.
struct Reference {
  Bounds squared_distance;
  std::span<const float> behaviour;
};

/// Exact squared distances from `from` to the `count` nearest references, ascending; fewer if there are
/// fewer. The bounds only save work: any valid bounds give the same result to the bit.
std::vector<double> nearest_squared_distances(std::span<const float> from,
                                              std::span<const Reference> references, std::size_t count);

}  // namespace amble::search
