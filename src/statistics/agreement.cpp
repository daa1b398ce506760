#include "amble/statistics/agreement.hpp"

#include <algorithm>
#include <cmath>

#include "amble/core/check.hpp"
#include "amble/statistics/distributions.hpp"

namespace amble::statistics {

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

}  // namespace amble::statistics
