#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "amble/statistics/interval.hpp"

namespace amble::statistics {

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

}  // namespace amble::statistics
