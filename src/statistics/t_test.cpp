#include "amble/statistics/t_test.hpp"

#include <algorithm>
#include <cmath>

#include "amble/core/check.hpp"
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

}  // namespace amble::statistics
