#include "amble/statistics/rank_test.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "amble/core/check.hpp"
#include "amble/statistics/descriptive.hpp"
#include "amble/statistics/distributions.hpp"

namespace amble::statistics {
namespace {

constexpr std::size_t largest_exact_sample = 8;

/// Infinities have a rank, what is no number has none.
void check_ranked(std::span<const double> sample) {
  AMBLE_CHECK(std::ranges::none_of(sample, [](double x) { return std::isnan(x); }),
              "values that are ranked are numbers");
}

/// Pairs in which the value of `first` is the larger one, ties half.
double pairs_won(std::span<const double> first, std::span<const double> second) {
  std::vector<double> sorted(second.begin(), second.end());
  std::ranges::sort(sorted);
  double won = 0.0;
  for (const double x : first) {
    const auto [first_equal, last_equal] = std::equal_range(sorted.begin(), sorted.end(), x);
    won += static_cast<double>(first_equal - sorted.begin()) +
           0.5 * static_cast<double>(last_equal - first_equal);
  }
  return won;
}

/// Sum of t³ − t over the sizes t of all groups of equal values; 0 without ties.
double tie_term(std::span<const double> first, std::span<const double> second) {
  std::vector<double> pooled(first.begin(), first.end());
  pooled.insert(pooled.end(), second.begin(), second.end());
  std::ranges::sort(pooled);
  double sum = 0.0;
  for (auto it = pooled.begin(); it != pooled.end();) {
    const auto end = std::upper_bound(it, pooled.end(), *it);
    const auto t = static_cast<double>(end - it);
    sum += t * t * t - t;
    it = end;
  }
  return sum;
}

/// P(U ≤ u) without ties. Mann and Whitney's recurrence, in probabilities: the largest of the pooled values
/// is with probability i / (i + j) one of the first sample's i, and then wins j pairs.
double exact_lower_tail(std::size_t n1, std::size_t n2, std::size_t u) {
  std::vector<std::vector<double>> p(n1 + 1, std::vector<double>(u + 1, 0.0));
  for (auto& row : p) row[0] = 1.0;
  for (std::size_t j = 1; j <= n2; ++j) {
    for (std::size_t i = 1; i <= n1; ++i) {
      const double largest_is_first = static_cast<double>(i) / static_cast<double>(i + j);
      for (std::size_t k = 0; k <= u; ++k) {
        const double if_first = k >= j ? p[i - 1][k - j] : 0.0;
        p[i][k] = largest_is_first * if_first + (1.0 - largest_is_first) * p[i][k];
      }
    }
  }
  double sum = 0.0;
  for (const double probability : p[n1]) sum += probability;
  return sum;
}

double asymptotic_upper_tail(double n1, double n2, double larger_u, double ties) {
  const double n = n1 + n2;
  const double variance = n1 * n2 / 12.0 * (n + 1.0 - ties / (n * (n - 1.0)));
  if (variance <= 0.0) return 1.0;  // all values are equal
  return normal_upper_tail((larger_u - 0.5 * n1 * n2 - 0.5) / std::sqrt(variance));
}

/// The θ below `estimate` at which estimate − θ is z standard errors; Newcombe's method 5.
double newcombe_lower(double estimate, double n1, double n2, double z) {
  const double n_star = 0.5 * (n1 + n2) - 1.0;
  double low = 0.0, high = estimate;
  // Bisection down to neighbouring numbers.
  for (;;) {
    const double theta = 0.5 * (low + high);
    if (theta <= low || theta >= high) return theta;
    const double bracket = 1.0 + n_star * (1.0 - theta) / (2.0 - theta) + n_star * theta / (1.0 + theta);
    const double variance = theta * (1.0 - theta) * bracket / (n1 * n2);
    (estimate - theta > z * std::sqrt(variance) ? low : high) = theta;
  }
}

}  // namespace

std::optional<MannWhitney> mann_whitney(std::span<const double> first, std::span<const double> second,
                                        MannWhitneyMethod method) {
  check_ranked(first);
  check_ranked(second);
  if (first.empty() || second.empty()) return {};
  const auto n1 = static_cast<double>(first.size()), n2 = static_cast<double>(second.size());
  const double ties = tie_term(first, second);
  AMBLE_CHECK(method != MannWhitneyMethod::exact || ties == 0.0, "the exact distribution of U knows no ties");
  const auto [smaller, larger] = std::minmax({first.size(), second.size()});

  MannWhitney test;
  test.u1 = pairs_won(first, second);
  test.u2 = n1 * n2 - test.u1;
  test.direction = direction_of(test.u1 - test.u2);
  test.exact = method == MannWhitneyMethod::exact ||
               (method == MannWhitneyMethod::automatic && smaller <= largest_exact_sample && ties == 0.0);
  const double tail =
      test.exact ? exact_lower_tail(smaller, larger, static_cast<std::size_t>(std::min(test.u1, test.u2)))
                 : asymptotic_upper_tail(n1, n2, std::max(test.u1, test.u2), ties);
  test.p = std::min(1.0, 2.0 * tail);
  return test;
}

double smallest_mann_whitney_p(std::size_t n1, std::size_t n2) {
  double p = 2.0;
  for (std::size_t i = 1; i <= n1; ++i) p *= static_cast<double>(i) / static_cast<double>(n2 + i);
  return std::min(1.0, p);
}

std::optional<Superiority> vargha_delaney(std::span<const double> first, std::span<const double> second,
                                          double confidence) {
  check_ranked(first);
  check_ranked(second);
  const double z = two_sided_z(confidence);
  if (first.empty() || second.empty()) return {};
  const auto n1 = static_cast<double>(first.size()), n2 = static_cast<double>(second.size());
  const double a12 = pairs_won(first, second) / (n1 * n2);
  // V(θ) = V(1 − θ), so the upper end is the lower one of the mirrored problem.
  return Superiority{a12, {newcombe_lower(a12, n1, n2, z), 1.0 - newcombe_lower(1.0 - a12, n1, n2, z)}};
}

}  // namespace amble::statistics
