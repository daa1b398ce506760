#pragma once

#include <optional>
#include <span>

#include "amble/statistics/descriptive.hpp"
#include "amble/statistics/t_test.hpp"

namespace amble::statistics {

/// A two-sided test that two variances are equal.
struct FTest {
  double ratio = 1.0;  ///< of the variances, first over second; infinite if the second is 0
  double degrees_of_freedom_first = 0.0, degrees_of_freedom_second = 0.0;
  double p = 1.0;
};

/// Fisher's F test of two variances (R's var.test). Exact for normal samples only: values with long tails
/// make p too small. Moments may be those that a publication prints. None if a sample has fewer than two
/// values, or if neither has any spread.
std::optional<FTest> f_test(const Moments& first, const Moments& second);

/// p, one-sided, of the test that a difference is at most −margin: if it is small, the first sample is not
/// worse than the second by more than the margin. Of the standard error and degrees of freedom of a t test.
/// margin ≥ 0.
double non_inferiority_p(const TTest& test, double margin);

/// Two one-sided tests (Schuirmann 1987) that a difference is at most −margin, and that it is at least
/// margin: the larger p. If it is small, the difference is within ± margin. p < α/2 is the same as that the
/// test's interval at confidence 1 − α lies within ± margin.
double equivalence_p(const TTest& test, double margin);

}  // namespace amble::statistics
