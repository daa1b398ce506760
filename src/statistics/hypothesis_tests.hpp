#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "amble/statistics/descriptive.hpp"

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

enum class MannWhitneyMethod {
  automatic,   ///< exact if no two values are equal and a sample has at most 8 of them, as SciPy's "auto"
  exact,       ///< from the distribution of U without ties; wrong if there are any
  asymptotic,  ///< normal, with corrections for ties and continuity
};

/// A two-sided test that neither sample tends to larger values.
struct MannWhitney {
  double u1 = 0.0, u2 = 0.0;  ///< pairs won by the first and by the second sample, ties half; sum n1 n2
  double p = 1.0;
  bool exact = false;
  Direction direction = Direction::equal;  ///< of the first sample, by u1 − u2
};

/// Mann and Whitney's U test (1947); the exact distribution by their recurrence, the normal approximation as
/// in Hollander, Wolfe & Chicken, Nonparametric Statistical Methods, 3rd ed., sec. 4.1. p is 1 if all values
/// are equal. None if a sample is empty; smallest_mann_whitney_p gives the limit of small samples. `exact`
/// with ties aborts. Time of the exact distribution grows with (n1 n2)².
std::optional<MannWhitney> mann_whitney(std::span<const double> first, std::span<const double> second,
                                        MannWhitneyMethod method = MannWhitneyMethod::automatic);

/// The least two-sided p that any samples of these sizes can have in the exact test, 2 / C(n1 + n2, n1) and
/// at most 1. If that is above the required level, the samples are too small for significance: 0.1 for 3
/// against 3.
double smallest_mann_whitney_p(std::size_t n1, std::size_t n2);

/// How probably a value of the first sample exceeds one of the second.
struct Superiority {
  double a12 = 0.5;   ///< in [0, 1]; 0.5: neither is larger
  Interval interval;  ///< inside [0, 1]
};

/// Vargha and Delaney's A12 (2000), P(X > Y) + P(X = Y) / 2 = U1 / (n1 n2): "probability of improvement" of
/// Agarwal et al. 2021, area under the ROC curve. Interval by method 5 of Newcombe (Statistics in Medicine
/// 25:559, 2006), which solves (a12 − θ)² = z² V(θ) for θ with Hanley and McNeil's variance V and so has a
/// width even where all of one sample exceed all of the other. None if a sample is empty.
std::optional<Superiority> vargha_delaney(std::span<const double> first, std::span<const double> second,
                                          double confidence = 0.95);

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

/// Holm's step-down adjustment (1979) of the p values of one family of tests, in their order. Rejecting where
/// the adjusted value is at most α keeps the probability of any false rejection at most α, however the tests
/// depend on each other. Values are in [0, 1]; tests that could not be made are not part of the family. An
/// empty family stays empty.
std::vector<double> holm(std::span<const double> p);

}  // namespace amble::statistics
