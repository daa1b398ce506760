#pragma once

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

}  // namespace amble::statistics
