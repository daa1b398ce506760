#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace amble::statistics {

/// A confidence interval, both ends included.
struct Interval {
  double lower = 0.0, upper = 0.0;

  bool contains(double value) const { return lower <= value && value <= upper; }
};

/// Where the first of two samples lies with respect to the second, as the statistic of the test has it.
enum class Direction { less, equal, greater };

inline Direction direction_of(double difference) {
  return difference < 0.0 ? Direction::less : difference > 0.0 ? Direction::greater : Direction::equal;
}

/// Everywhere in this folder a sample is finite numbers in any order; anything else fails an AMBLE_CHECK.
/// With too few values for a statistic the result is empty.
void check_finite(std::span<const double> sample);

/// Arithmetic mean of at least one value. Exactly x if all values are x, so that equal values have no spread.
double mean(std::span<const double> sample);

/// The median of at least one value; the mean of the two in the middle if their number is even.
double median(std::span<const double> sample);

/// Quantile of at least one value by linear interpolation between order statistics (type 7 of Hyndman & Fan
/// 1996; the default of R and NumPy). `probability` is in [0, 1].
double quantile(std::span<const double> sample, double probability);

/// Interquartile mean: mean of what is left when the floor(n/4) lowest and as many of the highest values are
/// dropped (Agarwal et al. 2021 and their rliable, by scipy.stats.trim_mean with 0.25). Values have no
/// fractional weights; so it is the mean of exactly the middle half where 4 divides n, and the plain mean for
/// n < 4. Of at least one value.
double interquartile_mean(std::span<const double> sample);

/// Size, mean and standard deviation: what a t test needs, and what publications print.
struct Moments {
  std::size_t n = 0;
  double mean = 0.0;
  double sd = 0.0;  ///< of a sample, with n − 1; not negative
};

/// None with fewer than two values, which have no standard deviation.
std::optional<Moments> moments(std::span<const double> sample);

/// Student's interval of a mean, mean ± t sd / √n with n − 1 degrees of freedom; of no width if sd is 0.
/// None with n < 2. `confidence` is in (0, 1).
std::optional<Interval> mean_interval(const Moments& sample, double confidence = 0.95);

/// A sample in a few numbers.
struct Summary {
  std::size_t n = 0;
  double mean = 0.0;
  std::optional<double> sd;               ///< none with one value
  std::optional<Interval> mean_interval;  ///< Student's; none with one value
  double minimum = 0.0, lower_quartile = 0.0, median = 0.0, upper_quartile = 0.0, maximum = 0.0;
  double interquartile_mean = 0.0;
};

/// None without values.
std::optional<Summary> summarize(std::span<const double> sample, double confidence = 0.95);

}  // namespace amble::statistics
