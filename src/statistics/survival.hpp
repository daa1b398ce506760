#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "amble/statistics/descriptive.hpp"

namespace amble::statistics {

/// How long something lasted, or was observed: a robot that stays up, until it falls or the test ends.
struct Lifetime {
  double time_s = 0.0;  ///< finite, not negative
  bool ended = true;    ///< false: censored, it still lasted when observation ended at time_s
};

/// One distinct time at which a lifetime ended or was censored.
struct SurvivalStep {
  double time_s = 0.0;
  std::size_t at_risk = 0;  ///< lasting, and observed, just before
  std::size_t ended = 0, censored = 0;
  double survival = 1.0;           ///< estimate of P(lifetime > time_s)
  std::optional<double> variance;  ///< Greenwood's, of `survival`; none once that is 0
  /// Pointwise confidence band; none once survival is 0, and for log_log none while it is 1.
  std::optional<Interval> band;
};

/// Scale on which the band is ± z standard errors. R's survfit: conf.type.
enum class SurvivalBand {
  log,      ///< of log S, R's default; the upper end is cut off at 1
  log_log,  ///< of log(−log S), inside [0, 1] by itself
};

/// Kaplan and Meier's estimate (1958): 1 before the first step, constant between steps.
struct SurvivalCurve {
  std::vector<SurvivalStep> steps;  ///< ascending in time
  std::size_t n = 0, ended = 0;
  /// The first time at which survival is at most 1/2, or the middle of the interval on which it is exactly
  /// that (as R's survfit has it); none if more than half last.
  std::optional<double> median_s;
  /// Where the ends of the band come down to 1/2 (Brookmeyer & Crowley 1982); none where they never do.
  std::optional<double> median_lower_s, median_upper_s;

  /// P(lifetime > time_s); beyond the last step what it was there.
  double at(double time_s) const;
};

/// What ends and is censored at one time was all at risk there. None without lifetimes. A single one is
/// enough for a curve, though hardly for its band.
std::optional<SurvivalCurve> kaplan_meier(std::span<const Lifetime> lifetimes, double confidence = 0.95,
                                          SurvivalBand band = SurvivalBand::log);

/// A test that k groups have one survival function.
struct LogRank {
  double chi_square = 0.0;
  std::size_t degrees_of_freedom = 1;  ///< groups that were at risk when a lifetime ended, minus one
  double p = 1.0;  ///< from the distribution of chi-square, which is off where groups are small
  /// Share of all ways to deal the lifetimes out to groups of these sizes with a chi-square at least as large
  /// (a permutation test); none where there are more than `most_arrangements` ways.
  std::optional<double> exact_p;
  std::vector<double> observed, expected;  ///< ends per group, as counted and under the hypothesis
};

inline constexpr double most_arrangements = 5000.0;

/// Log-rank test (Mantel 1966; Peto & Peto 1972) of any number of groups, as R's survdiff with rho = 0.
/// Groups that were at risk at no end of a lifetime (among them empty ones) do not count. None if fewer than
/// two groups are left, as when nothing ended. If all end at one and the same time, nothing speaks against
/// the hypothesis: chi-square 0, p = 1.
std::optional<LogRank> log_rank(std::span<const std::vector<Lifetime>> groups);

}  // namespace amble::statistics
