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

}  // namespace amble::statistics
