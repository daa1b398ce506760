#include "amble/statistics/descriptive.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "amble/core/check.hpp"
#include "amble/statistics/distributions.hpp"

namespace amble::statistics {
namespace {

std::vector<double> ascending(std::span<const double> sample) {
  check_finite(sample);
  AMBLE_CHECK(!sample.empty(), "a quantile needs a value");
  std::vector<double> values(sample.begin(), sample.end());
  std::ranges::sort(values);
  return values;
}

double quantile_of_sorted(std::span<const double> sorted, double probability) {
  AMBLE_CHECK(probability >= 0.0 && probability <= 1.0, "a probability is between 0 and 1");
  const double position = static_cast<double>(sorted.size() - 1) * probability;
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (position - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

double median_of_sorted(std::span<const double> sorted) {
  const std::size_t n = sorted.size();
  return 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]);
}

double interquartile_mean_of_sorted(std::span<const double> sorted) {
  const std::size_t dropped = sorted.size() / 4;
  return mean(sorted.subspan(dropped, sorted.size() - 2 * dropped));
}

}  // namespace

void check_finite(std::span<const double> sample) {
  AMBLE_CHECK(std::ranges::all_of(sample, [](double x) { return std::isfinite(x); }),
              "a sample has finite values only");
}

double mean(std::span<const double> sample) {
  AMBLE_CHECK(!sample.empty(), "a mean needs a value");
  // About the first value: differences of equal values are exactly zero, n x / n is not always x.
  double sum = 0.0;
  for (const double x : sample) sum += x - sample[0];
  return sample[0] + sum / static_cast<double>(sample.size());
}

double median(std::span<const double> sample) {
  return median_of_sorted(ascending(sample));
}

double quantile(std::span<const double> sample, double probability) {
  return quantile_of_sorted(ascending(sample), probability);
}

double interquartile_mean(std::span<const double> sample) {
  return interquartile_mean_of_sorted(ascending(sample));
}

std::optional<Moments> moments(std::span<const double> sample) {
  check_finite(sample);
  if (sample.size() < 2) return {};
  const double centre = mean(sample);
  double squares = 0.0;
  for (const double x : sample) squares += (x - centre) * (x - centre);
  return Moments{sample.size(), centre, std::sqrt(squares / static_cast<double>(sample.size() - 1))};
}

std::optional<Interval> mean_interval(const Moments& sample, double confidence) {
  AMBLE_CHECK(confidence > 0.0 && confidence < 1.0, "confidence is between 0 and 1");
  AMBLE_CHECK(sample.sd >= 0.0, "a standard deviation is not negative");
  if (sample.n < 2) return {};
  const auto n = static_cast<double>(sample.n);
  const double half = student_quantile(0.5 + 0.5 * confidence, n - 1.0) * sample.sd / std::sqrt(n);
  return Interval{sample.mean - half, sample.mean + half};
}

std::optional<Summary> summarize(std::span<const double> sample, double confidence) {
  if (sample.empty()) return {};
  const auto sorted = ascending(sample);
  Summary summary{.n = sample.size(),
                  .mean = mean(sample),
                  .sd = {},
                  .mean_interval = {},
                  .minimum = sorted.front(),
                  .lower_quartile = quantile_of_sorted(sorted, 0.25),
                  .median = median_of_sorted(sorted),
                  .upper_quartile = quantile_of_sorted(sorted, 0.75),
                  .maximum = sorted.back(),
                  .interquartile_mean = interquartile_mean_of_sorted(sorted)};
  if (const auto two_or_more = moments(sample)) {
    summary.sd = two_or_more->sd;
    summary.mean_interval = mean_interval(*two_or_more, confidence);
  }
  return summary;
}

}  // namespace amble::statistics
