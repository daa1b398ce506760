#include "amble/statistics/survival.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "amble/core/check.hpp"
#include "amble/statistics/distributions.hpp"

namespace amble::statistics {
namespace {

/// How near to 1/2 counts as 1/2, for products such as 2/3 · 3/4; R's, the root of the machine epsilon.
constexpr double half_tolerance = 0x1.0p-26;

/// `log_variance` is that of log S, and S > 0.
std::optional<Interval> band_of(double survival, double log_variance, double z, SurvivalBand band) {
  const double log_s = std::log(survival), half = z * std::sqrt(log_variance);
  if (band == SurvivalBand::log)
    return Interval{std::exp(log_s - half), std::min(1.0, std::exp(log_s + half))};
  if (survival == 1.0) return {};
  // S to the power of exp(± half / log S); log S is negative.
  return Interval{std::exp(log_s * std::exp(-half / log_s)), std::exp(log_s * std::exp(half / log_s))};
}

/// Where a falling step function, of which some steps may be missing, reaches 1/2.
std::optional<double> time_of_half(std::span<const SurvivalStep> steps,
                                   const std::function<std::optional<double>(const SurvivalStep&)>& height) {
  std::optional<double> start_s;
  for (const auto& step : steps) {
    const auto y = height(step);
    if (!y || *y >= 0.5 + half_tolerance) continue;
    if (start_s && *y < 0.5 - half_tolerance) return 0.5 * (*start_s + step.time_s);
    if (!start_s && *y <= 0.5 - half_tolerance) return step.time_s;
    if (!start_s) start_s = step.time_s;
  }
  return start_s;
}

using Matrix = std::vector<std::vector<double>>;

struct Member {
  double time_s;
  bool ended;
  std::size_t group;
};

std::vector<Member> by_time(std::span<const std::vector<Lifetime>> groups) {
  std::vector<Member> members;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (const auto& life : groups[g]) {
      AMBLE_CHECK(std::isfinite(life.time_s) && life.time_s >= 0.0, "lifetimes are finite and not negative");
      members.push_back({life.time_s, life.ended, g});
    }
  }
  std::ranges::sort(members, {}, &Member::time_s);
  return members;
}

struct Sums {
  std::vector<double> observed, expected;
  Matrix covariance;  ///< of observed − expected
};

/// Adds one time: `ends` of those `at_risk`, by group. The ends of a group are hypergeometric.
void add_time(Sums& sums, const std::vector<double>& at_risk, const std::vector<double>& ends) {
  double n = 0.0, d = 0.0;
  for (const double count : at_risk) n += count;
  for (const double count : ends) d += count;
  const double factor = n > 1.0 ? d * (n - d) / (n - 1.0) : 0.0;
  for (std::size_t g = 0; g < at_risk.size(); ++g) {
    const double share = at_risk[g] / n;
    sums.observed[g] += ends[g];
    sums.expected[g] += d * share;
    for (std::size_t h = 0; h < at_risk.size(); ++h)
      sums.covariance[g][h] += factor * share * ((g == h ? 1.0 : 0.0) - at_risk[h] / n);
  }
}

Sums sums_over_time(std::span<const std::vector<Lifetime>> groups) {
  const std::size_t k = groups.size();
  Sums sums{std::vector<double>(k), std::vector<double>(k), Matrix(k, std::vector<double>(k))};
  std::vector<double> at_risk(k), ends(k), left(k);
  for (std::size_t g = 0; g < k; ++g) at_risk[g] = static_cast<double>(groups[g].size());
  const auto members = by_time(groups);
  for (std::size_t i = 0; i < members.size();) {
    std::ranges::fill(ends, 0.0);
    std::ranges::fill(left, 0.0);
    const double time_s = members[i].time_s;
    for (; i < members.size() && members[i].time_s == time_s; ++i) {
      left[members[i].group] += 1.0;
      if (members[i].ended) ends[members[i].group] += 1.0;
    }
    if (std::ranges::any_of(ends, [](double count) { return count > 0.0; })) add_time(sums, at_risk, ends);
    for (std::size_t g = 0; g < k; ++g) at_risk[g] -= left[g];
  }
  return sums;
}

/// xᵀ A⁻¹ x for a symmetric positive definite A, by A = L Lᵀ: the squared norm of L⁻¹ x.
double inverse_quadratic_form(Matrix a, std::vector<double> x) {
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      for (std::size_t l = 0; l < j; ++l) a[i][j] -= a[i][l] * a[j][l];
      a[i][j] = j < i ? a[i][j] / a[j][j] : std::sqrt(a[i][i]);
    }
    for (std::size_t j = 0; j < i; ++j) x[i] -= a[i][j] * x[j];
    x[i] /= a[i][i];
    sum += x[i] * x[i];
  }
  return sum;
}

std::optional<LogRank> asymptotic_log_rank(std::span<const std::vector<Lifetime>> groups) {
  const Sums sums = sums_over_time(groups);
  std::vector<std::size_t> counted;
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (sums.expected[g] > 0.0) counted.push_back(g);
  if (counted.size() < 2) return {};

  LogRank test;
  test.observed = sums.observed;
  test.expected = sums.expected;
  test.degrees_of_freedom = counted.size() - 1;
  // Rows sum to zero, so one group is left out. What remains is regular unless all end at the first time:
  // every group was at risk there, and with a survivor the covariance of that time alone is regular.
  if (sums.covariance[counted[0]][counted[0]] == 0.0) return test;
  Matrix covariance;
  std::vector<double> excess;
  for (std::size_t i = 1; i < counted.size(); ++i) {
    const std::size_t g = counted[i];
    excess.push_back(sums.observed[g] - sums.expected[g]);
    auto& row = covariance.emplace_back();
    for (std::size_t j = 1; j < counted.size(); ++j) row.push_back(sums.covariance[g][counted[j]]);
  }
  test.chi_square = inverse_quadratic_form(std::move(covariance), std::move(excess));
  test.p = chi_square_upper_tail(test.chi_square, static_cast<double>(test.degrees_of_freedom));
  return test;
}

/// In how many ways the members of all groups can be dealt out to groups of these sizes.
double arrangements(std::span<const std::vector<Lifetime>> groups) {
  double ways = 1.0;
  std::size_t dealt = 0;
  for (const auto& group : groups)
    for (std::size_t i = 1; i <= group.size(); ++i)
      ways *= static_cast<double>(++dealt) / static_cast<double>(i);
  return std::round(ways);
}

/// LogRank::exact_p, by all arrangements.
double permutation_p(std::span<const std::vector<Lifetime>> groups, double chi_square) {
  std::vector<Lifetime> all;
  std::vector<std::size_t> labels;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const Lifetime& life : groups[g]) {
      all.push_back(life);
      labels.push_back(g);
    }
  // Arrangements that differ by members alike have the same chi-square but for rounding.
  const double least = chi_square * (1.0 - 1e-9);
  double ways = 0.0, as_far = 0.0;
  do {
    std::vector<std::vector<Lifetime>> dealt(groups.size());
    for (std::size_t i = 0; i < all.size(); ++i) dealt[labels[i]].push_back(all[i]);
    const auto test = asymptotic_log_rank(dealt);
    ++ways;
    as_far += (test ? test->chi_square : 0.0) >= least;
  } while (std::ranges::next_permutation(labels).found);
  return as_far / ways;
}

}  // namespace

double SurvivalCurve::at(double time_s) const {
  const auto after = std::ranges::upper_bound(steps, time_s, {}, &SurvivalStep::time_s);
  return after == steps.begin() ? 1.0 : std::prev(after)->survival;
}

std::optional<SurvivalCurve> kaplan_meier(std::span<const Lifetime> lifetimes, double confidence,
                                          SurvivalBand band) {
  const double z = two_sided_z(confidence);
  if (lifetimes.empty()) return {};
  std::vector<Lifetime> sorted(lifetimes.begin(), lifetimes.end());
  AMBLE_CHECK(std::ranges::all_of(sorted, [](auto& l) { return std::isfinite(l.time_s) && l.time_s >= 0.0; }),
              "lifetimes are finite and not negative");
  std::ranges::sort(sorted, {}, &Lifetime::time_s);

  SurvivalCurve curve;
  curve.n = sorted.size();
  double survival = 1.0, log_variance = 0.0;
  for (std::size_t i = 0; i < sorted.size();) {
    SurvivalStep step{.time_s = sorted[i].time_s, .at_risk = sorted.size() - i, .variance = {}, .band = {}};
    for (; i < sorted.size() && sorted[i].time_s == step.time_s; ++i)
      ++(sorted[i].ended ? step.ended : step.censored);
    curve.ended += step.ended;

    const auto n = static_cast<double>(step.at_risk), d = static_cast<double>(step.ended);
    survival *= (n - d) / n;
    step.survival = survival;
    if (survival > 0.0) {
      log_variance += d / (n * (n - d));  // Greenwood 1926
      step.variance = survival * survival * log_variance;
      step.band = band_of(survival, log_variance, z, band);
    }
    curve.steps.push_back(step);
  }

  using Height = std::optional<double>;
  curve.median_s = time_of_half(curve.steps, [](auto& step) { return Height(step.survival); });
  curve.median_lower_s =
      time_of_half(curve.steps, [](auto& step) { return step.band ? Height(step.band->lower) : Height(); });
  curve.median_upper_s =
      time_of_half(curve.steps, [](auto& step) { return step.band ? Height(step.band->upper) : Height(); });
  return curve;
}

std::optional<LogRank> log_rank(std::span<const std::vector<Lifetime>> groups) {
  auto test = asymptotic_log_rank(groups);
  if (test && arrangements(groups) <= most_arrangements)
    test->exact_p = permutation_p(groups, test->chi_square);
  return test;
}

}  // namespace amble::statistics
