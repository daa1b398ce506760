#include "amble/statistics/multiple_tests.hpp"

#include <algorithm>
#include <numeric>

#include "amble/core/check.hpp"

namespace amble::statistics {

std::vector<double> holm(std::span<const double> p) {
  AMBLE_CHECK(std::ranges::all_of(p, [](double value) { return value >= 0.0 && value <= 1.0; }),
              "p values are between 0 and 1");
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return p[i]; });

  std::vector<double> adjusted(p.size());
  double largest = 0.0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const auto not_yet_rejected = static_cast<double>(order.size() - rank);
    largest = std::max(largest, std::min(1.0, not_yet_rejected * p[order[rank]]));
    adjusted[order[rank]] = largest;
  }
  return adjusted;
}

}  // namespace amble::statistics
