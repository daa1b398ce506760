#include "amble/statistics/hypothesis_tests.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "amble/core/check.hpp"
#include "amble/statistics/descriptive.hpp"
#include "amble/statistics/distributions.hpp"

namespace amble::statistics {
namespace {

using Test = std::optional<TTest> (*)(const Moments&, const Moments&, double);

bool testable(const Moments& first, const Moments& second) {
  for (const auto* sample : {&first, &second})
    AMBLE_CHECK(std::isfinite(sample->mean) && std::isfinite(sample->sd) && sample->sd >= 0.0,
                "moments are finite and a standard deviation is not negative");
  return first.n >= 2 && second.n >= 2 && (first.sd > 0.0 || second.sd > 0.0);
}

TTest test_of(double difference, double standard_error, double degrees_of_freedom, double confidence) {
  AMBLE_CHECK(confidence > 0.0 && confidence < 1.0, "confidence is between 0 and 1");
  const double t = difference / standard_error;
  const double half = student_quantile(0.5 + 0.5 * confidence, degrees_of_freedom) * standard_error;
  return {.t = t,
          .degrees_of_freedom = degrees_of_freedom,
          .p = std::min(1.0, 2.0 * student_upper_tail(std::abs(t), degrees_of_freedom)),
          .difference = difference,
          .standard_error = standard_error,
          .interval = {difference - half, difference + half},
          .direction = direction_of(difference)};
}

std::optional<TTest> of_samples(Test test, std::span<const double> first, std::span<const double> second,
                                double confidence) {
  const auto a = moments(first), b = moments(second);
  if (!a || !b) return {};
  return test(*a, *b, confidence);
}

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

std::optional<TTest> student_t_test(const Moments& first, const Moments& second, double confidence) {
  if (!testable(first, second)) return {};
  const auto n1 = static_cast<double>(first.n), n2 = static_cast<double>(second.n);
  const double df = n1 + n2 - 2.0;
  const double pooled_variance = ((n1 - 1.0) * first.sd * first.sd + (n2 - 1.0) * second.sd * second.sd) / df;
  return test_of(first.mean - second.mean, std::sqrt(pooled_variance * (1.0 / n1 + 1.0 / n2)), df,
                 confidence);
}

std::optional<TTest> student_t_test(std::span<const double> first, std::span<const double> second,
                                    double confidence) {
  return of_samples(student_t_test, first, second, confidence);
}

std::optional<TTest> welch_t_test(const Moments& first, const Moments& second, double confidence) {
  if (!testable(first, second)) return {};
  const auto n1 = static_cast<double>(first.n), n2 = static_cast<double>(second.n);
  const double scale = std::max(first.sd, second.sd);
  const double a = first.sd / scale * (first.sd / scale) / n1;
  const double b = second.sd / scale * (second.sd / scale) / n2;
  const double df = (a + b) * (a + b) / (a * a / (n1 - 1.0) + b * b / (n2 - 1.0));
  return test_of(first.mean - second.mean, scale * std::sqrt(a + b), df, confidence);
}

std::optional<TTest> welch_t_test(std::span<const double> first, std::span<const double> second,
                                  double confidence) {
  return of_samples(welch_t_test, first, second, confidence);
}

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

std::optional<FTest> f_test(const Moments& first, const Moments& second) {
  for (const auto* sample : {&first, &second})
    AMBLE_CHECK(std::isfinite(sample->sd) && sample->sd >= 0.0, "a standard deviation is not negative");
  if (first.n < 2 || second.n < 2 || (first.sd == 0.0 && second.sd == 0.0)) return {};
  FTest test{.degrees_of_freedom_first = static_cast<double>(first.n) - 1.0,
             .degrees_of_freedom_second = static_cast<double>(second.n) - 1.0};
  if (second.sd == 0.0) {
    test.ratio = INFINITY;
    test.p = 0.0;
    return test;
  }
  test.ratio = first.sd / second.sd * (first.sd / second.sd);
  // The lower tail of F is the upper tail of 1/F, which keeps its digits where it is small.
  const double upper =
      f_upper_tail(test.ratio, test.degrees_of_freedom_first, test.degrees_of_freedom_second);
  const double lower = test.ratio > 0.0 ? f_upper_tail(1.0 / test.ratio, test.degrees_of_freedom_second,
                                                       test.degrees_of_freedom_first)
                                        : 0.0;
  test.p = std::min(1.0, 2.0 * std::min(lower, upper));
  return test;
}

double non_inferiority_p(const TTest& test, double margin) {
  AMBLE_CHECK(margin >= 0.0 && test.standard_error > 0.0, "a margin, and a t test with a scale");
  return student_upper_tail((test.difference + margin) / test.standard_error, test.degrees_of_freedom);
}

double equivalence_p(const TTest& test, double margin) {
  TTest mirrored = test;
  mirrored.difference = -test.difference;
  return std::max(non_inferiority_p(test, margin), non_inferiority_p(mirrored, margin));
}

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
