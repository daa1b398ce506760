#include "amble/statistics/proportions.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "amble/core/check.hpp"
#include "amble/statistics/distributions.hpp"

namespace amble::statistics {
namespace {

constexpr double equally_probable = 1.0 + 1e-7;

void check(Count count) {
  AMBLE_CHECK(count.successes <= count.trials, "no more successes than trials");
}

/// Probabilities of 0 … trials successes of the first, given the sum of successes, up to a common factor;
/// the largest is 1, and products of neighbours' ratios lead away from it.
std::vector<double> hypergeometric(Count first, Count second) {
  const auto n1 = static_cast<double>(first.trials), n2 = static_cast<double>(second.trials);
  const auto successes = static_cast<double>(first.successes + second.successes);
  // weight[k + 1] / weight[k]
  const auto ratio = [&](std::uint64_t k) {
    const auto x = static_cast<double>(k);
    return std::max(0.0, n1 - x) * std::max(0.0, successes - x) / ((x + 1.0) * (n2 - successes + x + 1.0));
  };
  const std::uint64_t least =
      first.successes + second.successes - std::min(first.successes + second.successes, second.trials);
  const std::uint64_t most = std::min(first.trials, first.successes + second.successes);
  std::uint64_t mode = least;
  while (mode < most && ratio(mode) > 1.0) ++mode;

  std::vector<double> weights(first.trials + 1, 0.0);
  weights[mode] = 1.0;
  for (std::uint64_t k = mode; k < most; ++k) weights[k + 1] = weights[k] * ratio(k);
  for (std::uint64_t k = mode; k > least; --k) weights[k - 1] = weights[k] / ratio(k - 1);
  return weights;
}

}  // namespace

std::optional<Interval> clopper_pearson(Count count, double confidence) {
  check(count);
  AMBLE_CHECK(confidence > 0.0 && confidence < 1.0, "confidence is between 0 and 1");
  if (count.trials == 0) return {};
  const auto k = static_cast<double>(count.successes), n = static_cast<double>(count.trials);
  const double tail = 0.5 * (1.0 - confidence);
  return Interval{count.successes == 0 ? 0.0 : beta_quantile(tail, k, n - k + 1.0),
                  count.successes == count.trials ? 1.0 : beta_quantile(1.0 - tail, k + 1.0, n - k)};
}

std::optional<Interval> wilson(Count count, double confidence) {
  check(count);
  const double z = two_sided_z(confidence);
  if (count.trials == 0) return {};
  const auto n = static_cast<double>(count.trials);
  const double p = static_cast<double>(count.successes) / n;
  const double centre = p + z * z / (2.0 * n);
  const double half = z * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
  const double scale = 1.0 + z * z / n;
  // Rounding would leave 1e-17 where the end is exactly 0 or 1.
  return Interval{count.successes == 0 ? 0.0 : (centre - half) / scale,
                  count.successes == count.trials ? 1.0 : (centre + half) / scale};
}

std::optional<FisherTest> fisher_exact(Count first, Count second) {
  check(first);
  check(second);
  if (first.trials == 0 || second.trials == 0) return {};

  const auto weights = hypergeometric(first, second);
  const double seen = weights[first.successes];
  double all = 0.0, as_extreme = 0.0;
  for (const double weight : weights) {
    all += weight;
    if (weight <= seen * equally_probable) as_extreme += weight;
  }

  const auto a = static_cast<double>(first.successes), c = static_cast<double>(second.successes);
  const auto b = static_cast<double>(first.trials) - a, d = static_cast<double>(second.trials) - c;
  FisherTest test;
  test.p = std::min(1.0, as_extreme / all);
  if (b * c > 0.0) test.odds_ratio = a * d / (b * c);
  test.direction = direction_of(a * d - b * c);
  return test;
}

}  // namespace amble::statistics
