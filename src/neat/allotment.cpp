#include "amble/neat/allotment.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"

namespace amble::neat {

std::vector<int> allot_places(std::span<const double> shares, int total, std::optional<std::size_t> kept) {
  AMBLE_CHECK(kept.value_or(0) < shares.size() && total > 0, "places are for at least one species");
  const double largest = std::ranges::max(shares);
  // Divided by the largest, shares near the limits of double neither overflow nor vanish together.
  std::vector<double> quotas(shares.size(), 1.0);
  if (largest > 0.0)
    std::ranges::transform(shares, quotas.begin(), [&](double share) { return share / largest; });
  const double sum = std::accumulate(quotas.begin(), quotas.end(), 0.0);

  std::vector<int> places;
  std::vector<double> remainders;
  for (const double quota : quotas) {
    const double exact = quota / sum * total;
    places.push_back(static_cast<int>(exact));
    remainders.push_back(exact - std::floor(exact));
  }
  const int left = total - std::accumulate(places.begin(), places.end(), 0);
  AMBLE_CHECK(left >= 0 && to_index(left) <= places.size(), "rounding down loses less than one each");

  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order,
                           [&](std::size_t a, std::size_t b) { return remainders[a] > remainders[b]; });
  for (std::size_t i = 0; i < to_index(left); ++i) ++places[order[i]];

  if (kept && places[*kept] == 0) {
    --*std::ranges::max_element(places);
    ++places[*kept];
  }
  return places;
}

}  // namespace amble::neat
