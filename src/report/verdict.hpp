#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "amble/report/study_data.hpp"
#include "amble/report/verdict_rules.hpp"
#include "amble/statistics/descriptive.hpp"

namespace amble::report {

/// The result of judging one claim.
struct Judgement {
  Verdict verdict = Verdict::not_testable;
  std::string reason;  ///< why, in a sentence or two

  std::size_t n = 0, planned = 0;                  ///< runs of the condition that were used, of so many
  std::size_t n_against = 0, planned_against = 0;  ///< of the other condition, 0 if there is none
  std::string quantity;                          ///< what `estimate` is: "difference of means", "ratio", …
  std::optional<double> estimate;                ///< in the unit of the measure where it has one
  std::optional<statistics::Interval> interval;  ///< of the estimate
  std::optional<double> mean, mean_against;      ///< of the measure, where means are compared
  std::string test;                              ///< name of the test; empty: none was made
  std::optional<double> p;                       ///< two-sided
  std::optional<double> p_holm;                  ///< difference: adjusted over its family
  /// One-sided: of a value, that its mean is within the claim's share of the published one (two one-sided
  /// tests); of a difference that is not_less and states a margin, that it is not worse by more, adjusted.
  std::optional<double> p_equivalence;
  std::optional<double> p_spread;  ///< value: F test of the two variances
  std::string ours;                ///< the estimate as displayed next to the published figure
};

/// Judges all claims of a study, in their order. Claims of differences are two families, those of `greater`
/// and those of `not_less`: the p values of each are adjusted together by Holm's method, those without a test
/// left out. A condition with fewer than `fewest_judged` runs decides nothing.
std::vector<Judgement> judge(const StudyData& data);

/// The judgement on a claim of a count if its runs had these values of the measure.
Judgement judge_count_of(const StudyData& data, const ledger::ClaimSpec& claim,
                         const std::vector<double>& sample);

/// How many claims got each verdict, in the order of `verdict_names`.
std::array<std::size_t, verdict_names.size()> count_verdicts(const std::vector<Judgement>& judgements);

}  // namespace amble::report
