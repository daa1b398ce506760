#pragma once

#include <optional>
#include <span>

#include "amble/statistics/descriptive.hpp"
#include "amble/statistics/interval.hpp"

namespace amble::statistics {

/// A two-sided test that two means are equal.
struct TTest {
  double t = 0.0;
  double degrees_of_freedom = 0.0;
  double p = 1.0;
  double difference = 0.0;      ///< mean of the first sample minus that of the second
  double standard_error = 0.0;  ///< of the difference
  Interval interval;            ///< of the difference
  Direction direction = Direction::equal;
};

/// Student's t test for two independent samples of equal variance (pooled), n1 + n2 − 2 degrees of freedom.
/// None if a sample has fewer than two values, or if neither has any spread (t would be 0/0 or infinite).
std::optional<TTest> student_t_test(const Moments& first, const Moments& second, double confidence = 0.95);
std::optional<TTest> student_t_test(std::span<const double> first, std::span<const double> second,
                                    double confidence = 0.95);

/// Welch's t test (Welch 1947), variances may differ, degrees of freedom by Welch and Satterthwaite. Moments
/// may be those that a publication prints. None in the same cases as for Student's.
std::optional<TTest> welch_t_test(const Moments& first, const Moments& second, double confidence = 0.95);
std::optional<TTest> welch_t_test(std::span<const double> first, std::span<const double> second,
                                  double confidence = 0.95);

}  // namespace amble::statistics
