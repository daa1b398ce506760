#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "amble/statistics/descriptive.hpp"

namespace amble::statistics {

struct BootstrapOptions {
  std::uint64_t seed = 1;
  std::uint32_t resamples = 10'000;  ///< at least 1
  double confidence = 0.95;          ///< in (0, 1)
};

/// Bias-corrected and accelerated (BCa) bootstrap interval of Efron (1987; Efron & Tibshirani, An
/// Introduction to the Bootstrap, 1993, 14.3), for several samples with the acceleration of their eq. 15.36.
/// Computed as scipy.stats.bootstrap does: ties with the estimate count half in the bias correction,
/// quantiles of type 7. Values that differ by rounding only (1e-12) are ties.
struct BootstrapInterval {
  double estimate = 0.0;  ///< the statistic of the samples themselves
  Interval interval;
  double standard_error = 0.0;   ///< standard deviation over the resamples
  double bias_correction = 0.0;  ///< z0
  double acceleration = 0.0;     ///< a; 0 where leaving out any one value changes nothing
  /// All resamples gave one number, so the interval has no width and no meaning for other samples.
  bool degenerate = false;
};

/// Every function here returns nothing if a sample has fewer than two values, or if the statistic of the
/// samples, of a resample or of the samples without one value is not finite (a ratio over zero).
///
/// Resample r of sample i is drawn from Stream(seed, Purpose::bootstrap, 0, i), so the same samples, seed and
/// options give the same bits, and intervals of several statistics of one sample share their resamples.
/// Samples are sorted before they are drawn from (pairs by their first values): the result does not depend on
/// the order in which they are given.

/// A function of one sample of at least one value: mean, median, interquartile_mean, …
using Statistic = std::function<double(std::span<const double>)>;

std::optional<BootstrapInterval> bootstrap(std::span<const double> sample, const Statistic& statistic,
                                           const BootstrapOptions& options = {});

/// Interval of statistic(first) − statistic(second); the samples are independent, resampled one by one.
std::optional<BootstrapInterval> bootstrap_difference(std::span<const double> first,
                                                      std::span<const double> second,
                                                      const Statistic& statistic,
                                                      const BootstrapOptions& options = {});

/// Interval of statistic(first) / statistic(second), of independent samples.
std::optional<BootstrapInterval> bootstrap_ratio(std::span<const double> first,
                                                 std::span<const double> second, const Statistic& statistic,
                                                 const BootstrapOptions& options = {});

/// Interval of sum(numerators) / sum(denominators), where the values come in pairs, one per run, that are
/// drawn together: by what factor farther champions walk in the long test than in training. Both have one
/// length.
std::optional<BootstrapInterval> bootstrap_paired_ratio(std::span<const double> numerators,
                                                        std::span<const double> denominators,
                                                        const BootstrapOptions& options = {});

/// Which elements of one sample a resample has: ascending indices, an element drawn twice is there twice.
using Picks = std::vector<std::uint32_t>;

/// A function of one resample per sample, in the order of the sizes.
using PickStatistic = std::function<double(std::span<const Picks>)>;

/// The general form, for cases that the others do not cover (e.g. differences of paired ratios): samples of
/// these sizes, whose values and order only the caller knows.
std::optional<BootstrapInterval> bootstrap_picks(std::span<const std::size_t> sizes,
                                                 const PickStatistic& statistic,
                                                 const BootstrapOptions& options = {});

}  // namespace amble::statistics
