#include "amble/neat/shares.hpp"

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

std::size_t roulette(std::span<const double> weights, Stream& stream) {
  AMBLE_CHECK(!weights.empty(), "a roulette has at least one sector");
  const double draw = stream.uniform();
  const double largest = std::ranges::max(weights);
  if (largest == 0.0) return static_cast<std::size_t>(draw * static_cast<double>(weights.size()));

  // Divided by the largest, weights near the limits of double neither overflow nor vanish together.
  double total = 0.0;
  for (const double weight : weights) total += weight / largest;
  const double target = draw * total;
  double sum = 0.0;
  std::size_t last_possible = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] == 0.0) continue;
    sum += weights[i] / largest;
    last_possible = i;
    if (target < sum) return i;
  }
  return last_possible;
}

}  // namespace amble::neat
