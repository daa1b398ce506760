#include "amble/statistics/bootstrap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/random.hpp"
#include "amble/statistics/descriptive.hpp"
#include "amble/statistics/distributions.hpp"

namespace amble::statistics {
namespace {

/// Replicates as near as that to the estimate, relative to the largest, are ties: sums of the same numbers in
/// another order.
constexpr double rounding = 1e-12;

/// Draws resamples of one sample, as ascending indices.
class Resampler {
 public:
  Resampler(std::uint64_t seed, std::uint32_t sample, std::size_t size)
      : stream_(seed, Purpose::bootstrap, 0, sample), times_(size) {}

  void draw(Picks& picks) {
    std::ranges::fill(times_, 0u);
    const auto n = static_cast<std::uint32_t>(times_.size());
    for (std::uint32_t i = 0; i < n; ++i) ++times_[stream_.below(n)];
    picks.resize(n);
    auto next = picks.begin();
    for (std::uint32_t i = 0; i < n; ++i) next = std::fill_n(next, times_[i], i);
  }

 private:
  Stream stream_;
  std::vector<std::uint32_t> times_;
};

std::vector<Picks> whole_samples(std::span<const std::size_t> sizes) {
  std::vector<Picks> picks;
  for (const std::size_t n : sizes) {
    Picks& all = picks.emplace_back(n);
    std::iota(all.begin(), all.end(), 0u);
  }
  return picks;
}

/// None if a resample has no finite statistic.
std::optional<std::vector<double>> replicates(std::span<const std::size_t> sizes,
                                              const PickStatistic& statistic,
                                              const BootstrapOptions& options) {
  std::vector<Resampler> resamplers;
  for (std::uint32_t i = 0; i < sizes.size(); ++i) resamplers.emplace_back(options.seed, i, sizes[i]);
  std::vector<Picks> picks(sizes.size());
  std::vector<double> values(options.resamples);
  for (double& value : values) {
    for (std::size_t i = 0; i < sizes.size(); ++i) resamplers[i].draw(picks[i]);
    value = statistic(picks);
    if (!std::isfinite(value)) return {};
  }
  std::ranges::sort(values);
  return values;
}

/// The statistic with each element of sample `i` left out; not necessarily finite.
std::vector<double> jackknife(std::span<const std::size_t> sizes, std::size_t i,
                              const PickStatistic& statistic) {
  auto picks = whole_samples(sizes);
  Picks& without = picks[i];
  without.pop_back();
  std::vector<double> values(sizes[i]);
  for (std::size_t left_out = sizes[i]; left_out-- > 0;) {
    values[left_out] = statistic(picks);
    // 0 … left_out − 2, left_out, …
    if (left_out > 0) ++without[left_out - 1];
  }
  return values;
}

/// Efron & Tibshirani 1993, eq. 14.15 for one sample, 15.36 for several; none if not finite.
std::optional<double> acceleration(std::span<const std::size_t> sizes, const PickStatistic& statistic) {
  double cubes = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const auto values = jackknife(sizes, i, statistic);
    if (!std::ranges::all_of(values, [](double x) { return std::isfinite(x); })) return {};
    const auto n = static_cast<double>(sizes[i]);
    const double centre = mean(values);
    for (const double value : values) {
      const double influence = (n - 1.0) * (centre - value) / n;
      squares += influence * influence;
      cubes += influence * influence * influence;
    }
  }
  return squares > 0.0 ? cubes / (6.0 * squares * std::sqrt(squares)) : 0.0;
}

/// z0: the quantile of the estimate among the replicates, kept off 0 and 1, where it would be infinite.
double bias_correction(std::span<const double> sorted, double estimate) {
  const double margin = rounding * std::max(std::abs(sorted.front()), std::abs(sorted.back()));
  const auto first = std::ranges::lower_bound(sorted, estimate - margin);
  const auto last = std::ranges::upper_bound(sorted, estimate + margin);
  const auto n = static_cast<double>(sorted.size());
  const double rank = 0.5 * static_cast<double>((first - sorted.begin()) + (last - sorted.begin()));
  return normal_quantile(std::clamp(rank, 0.5, n - 0.5) / n);
}

/// Which quantile of the replicates takes the place of the one at `z`. Efron & Tibshirani 1993, eq. 14.10.
double corrected_probability(double z, double z0, double a) {
  const double sum = z0 + z, denominator = 1.0 - a * sum;
  if (denominator <= 0.0) return sum > 0.0 ? 1.0 : 0.0;  // beyond the pole
  return normal_cdf(z0 + sum / denominator);
}

double standard_deviation(std::span<const double> values) {
  const auto both = moments(values);
  return both ? both->sd : 0.0;
}

/// The statistics of one resample each, from values that are sorted once.
class Values {
 public:
  explicit Values(std::span<const double> sample) : sorted_(sample.begin(), sample.end()) {
    check_finite(sample);
    std::ranges::sort(sorted_);
  }

  std::span<const double> operator()(const Picks& picks) {
    picked_.resize(picks.size());
    std::ranges::transform(picks, picked_.begin(), [&](std::uint32_t i) { return sorted_[i]; });
    return picked_;
  }

 private:
  std::vector<double> sorted_, picked_;
};

template <class Combine>
std::optional<BootstrapInterval> of_two(std::span<const double> first, std::span<const double> second,
                                        const Statistic& statistic, const BootstrapOptions& options,
                                        Combine combine) {
  const std::size_t sizes[] = {first.size(), second.size()};
  Values a(first), b(second);
  return bootstrap_picks(
      sizes,
      [&](std::span<const Picks> picks) { return combine(statistic(a(picks[0])), statistic(b(picks[1]))); },
      options);
}

}  // namespace

std::optional<BootstrapInterval> bootstrap_picks(std::span<const std::size_t> sizes,
                                                 const PickStatistic& statistic,
                                                 const BootstrapOptions& options) {
  AMBLE_CHECK(!sizes.empty() && options.resamples > 0, "a bootstrap has a sample and resamples");
  const double z = two_sided_z(options.confidence);
  for (const std::size_t n : sizes) {
    if (n < 2) return {};
    AMBLE_CHECK(n <= std::numeric_limits<std::uint32_t>::max(), "a sample is too large to resample");
  }

  BootstrapInterval result;
  result.estimate = statistic(whole_samples(sizes));
  if (!std::isfinite(result.estimate)) return {};
  const auto sorted = replicates(sizes, statistic, options);
  const auto a = acceleration(sizes, statistic);
  if (!sorted || !a) return {};

  result.acceleration = *a;
  result.degenerate = sorted->front() == sorted->back();
  if (result.degenerate) {
    result.interval = {sorted->front(), sorted->front()};
    return result;
  }
  result.standard_error = standard_deviation(*sorted);
  result.bias_correction = bias_correction(*sorted, result.estimate);
  const auto end = [&](double at) {
    return quantile(*sorted, corrected_probability(at, result.bias_correction, result.acceleration));
  };
  result.interval = {end(-z), end(z)};
  return result;
}

std::optional<BootstrapInterval> bootstrap(std::span<const double> sample, const Statistic& statistic,
                                           const BootstrapOptions& options) {
  const std::size_t sizes[] = {sample.size()};
  Values values(sample);
  return bootstrap_picks(
      sizes, [&](std::span<const Picks> picks) { return statistic(values(picks[0])); }, options);
}

std::optional<BootstrapInterval> bootstrap_difference(std::span<const double> first,
                                                      std::span<const double> second,
                                                      const Statistic& statistic,
                                                      const BootstrapOptions& options) {
  return of_two(first, second, statistic, options, [](double a, double b) { return a - b; });
}

std::optional<BootstrapInterval> bootstrap_ratio(std::span<const double> first,
                                                 std::span<const double> second, const Statistic& statistic,
                                                 const BootstrapOptions& options) {
  return of_two(first, second, statistic, options, [](double a, double b) { return a / b; });
}

std::optional<BootstrapInterval> bootstrap_paired_ratio(std::span<const double> numerators,
                                                        std::span<const double> denominators,
                                                        const BootstrapOptions& options) {
  AMBLE_CHECK(numerators.size() == denominators.size(), "pairs have two values each");
  check_finite(numerators);
  check_finite(denominators);
  std::vector<std::pair<double, double>> pairs;
  for (std::size_t i = 0; i < numerators.size(); ++i) pairs.emplace_back(numerators[i], denominators[i]);
  std::ranges::sort(pairs);

  const std::size_t sizes[] = {pairs.size()};
  const auto ratio = [&](std::span<const Picks> picks) {
    double above = 0.0, below = 0.0;
    for (const std::uint32_t i : picks[0]) {
      above += pairs[i].first;
      below += pairs[i].second;
    }
    return above / below;
  };
  return bootstrap_picks(sizes, ratio, options);
}

}  // namespace amble::statistics
