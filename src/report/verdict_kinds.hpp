#pragma once

#include "amble/report/verdict.hpp"

namespace amble::report {

/// One claim with its numbers and, but for differences, its verdict (docs/STUDIES.md). The verdict on a
/// difference needs its adjusted p value: conclude_difference(). Counts and gaits are in verdict_counts.cpp,
/// the others in verdict_means.cpp.
Judgement judge_difference(const StudyData& data, const ledger::ClaimSpec& claim);
Judgement judge_ratio(const StudyData& data, const ledger::ClaimSpec& claim);
Judgement judge_value(const StudyData& data, const ledger::ClaimSpec& claim);
Judgement judge_plateau(const StudyData& data, const ledger::ClaimSpec& claim);
Judgement judge_count(const StudyData& data, const ledger::ClaimSpec& claim,
                      const std::vector<double>& sample);
Judgement judge_gaits(const StudyData& data, const ledger::ClaimSpec& claim);

/// `judgement` has an estimate, p and p_holm, and p_equivalence if the claim states a margin.
void conclude_difference(const ledger::ClaimSpec& claim, Judgement& judgement);

/// A judgement with how many runs of the condition have the measure.
Judgement begin_judgement(const StudyData& data, const ledger::ClaimSpec& claim, std::size_t n);

/// "supg: 1 run has the measure, a test needs 2", or nothing if there are enough.
std::string too_few(const StudyData& data, const std::string& condition, std::size_t n, std::size_t needed);

/// "2 of 3 runs of supg never reached it: there is no mean." of infinite values of a measure; nothing if all
/// are finite.
std::string without_mean(const StudyData& data, const std::string& condition, const std::string& measure,
                         const std::vector<double>& values);

}  // namespace amble::report
