#include "amble/neat/roulette.hpp"

#include <algorithm>

#include "amble/core/check.hpp"

namespace amble::neat {

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
