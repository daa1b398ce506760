#include "amble/search/nearest.hpp"

#include <algorithm>
#include <limits>

namespace amble::search {
namespace {

/// An upper bound of the `count`-th smallest squared distance: the `count`-th smallest upper bound.
double reach_of(std::span<const Reference> references, std::size_t count) {
  if (references.size() <= count) return std::numeric_limits<double>::infinity();
  std::vector<double> upper;
  upper.reserve(references.size());
  for (const auto& reference : references) upper.push_back(reference.squared_distance.upper);
  const auto last = upper.begin() + static_cast<std::ptrdiff_t>(count - 1);
  std::ranges::nth_element(upper, last);
  return *last;
}

}  // namespace

std::vector<double> nearest_squared_distances(std::span<const float> from,
                                              std::span<const Reference> references, std::size_t count) {
  if (count == 0) return {};
  const double reach = reach_of(references, count);
  std::vector<double> distances;
  // A reference whose lower bound exceeds the reach cannot be among the nearest.
  for (const auto& reference : references)
    if (reference.squared_distance.lower <= reach)
      distances.push_back(exact_squared_distance(from, reference.behaviour));
  const std::size_t kept = std::min(count, distances.size());
  std::ranges::partial_sort(distances, distances.begin() + static_cast<std::ptrdiff_t>(kept));
  distances.resize(kept);
  return distances;
}

}  // namespace amble::search
