#include "amble/search/nearest.hpp"

#include <algorithm>
#include <limits>

namespace amble::search {
namespace {

/// A squared distance that at least `count` candidates are certainly within.
double reach_of(std::span<const Candidate> candidates, std::size_t count) {
  if (candidates.size() <= count) return std::numeric_limits<double>::infinity();
  std::vector<double> upper;
  upper.reserve(candidates.size());
  for (const auto& candidate : candidates) upper.push_back(candidate.squared_distance.upper);
  const auto last = upper.begin() + static_cast<std::ptrdiff_t>(count - 1);
  std::ranges::nth_element(upper, last);
  return *last;
}

}  // namespace

std::vector<double> nearest_squared_distances(std::span<const float> from,
                                              std::span<const Candidate> candidates, std::size_t count) {
  if (count == 0) return {};
  const double reach = reach_of(candidates, count);
  std::vector<double> distances;
  for (const auto& candidate : candidates)
    if (candidate.squared_distance.lower <= reach)
      distances.push_back(exact_squared_distance(from, candidate.behaviour));
  const std::size_t kept = std::min(count, distances.size());
  std::ranges::partial_sort(distances, distances.begin() + static_cast<std::ptrdiff_t>(kept));
  distances.resize(kept);
  return distances;
}

}  // namespace amble::search
