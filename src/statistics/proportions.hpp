#pragma once

#include <cstdint>
#include <optional>

#include "amble/statistics/descriptive.hpp"

namespace amble::statistics {

/// k successes in n trials: runs whose champion walks to the end, say. successes ≤ trials.
struct Count {
  std::uint64_t successes = 0, trials = 0;
};

/// Clopper and Pearson's interval of a probability (1934), from quantiles of the beta distribution. Covers at
/// least as often as `confidence` says, and mostly more often. None without trials.
std::optional<Interval> clopper_pearson(Count count, double confidence = 0.95);

/// Wilson's score interval of a probability (1927), without correction for continuity. Narrower than Clopper
/// and Pearson's, covers about as often as `confidence` says on average. None without trials.
std::optional<Interval> wilson(Count count, double confidence = 0.95);

/// A two-sided test that two probabilities are equal.
struct FisherTest {
  double p = 1.0;
  std::optional<double> odds_ratio;        ///< of the sample, first over second; none where it would be x/0
  Direction direction = Direction::equal;  ///< of the first proportion
};

/// Fisher's exact test of a 2 × 2 table. p is the sum of the hypergeometric probabilities of all tables with
/// the same margins that are no more probable than the one seen (equal up to a factor of 1 + 1e-7, as in R's
/// fisher.test). p is 1 if all trials end the same way. None if one of the two has no trials.
std::optional<FisherTest> fisher_exact(Count first, Count second);

}  // namespace amble::statistics
