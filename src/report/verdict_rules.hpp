#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/ledger/claim_spec.hpp"
#include "amble/statistics/interval.hpp"

namespace amble::report {

/// The verdict on a claim. The rules are in docs/STUDIES.md.
enum class Verdict : std::uint8_t { confirmed, not_confirmed, contradicted, not_testable };
inline constexpr std::array<std::string_view, 4> verdict_names{"confirmed", "not confirmed", "contradicted",
                                                               "not testable"};
inline std::string_view name_of(Verdict verdict) {
  return verdict_names[to_index(verdict)];
}

/// `direction`: where the condition's sample lies with respect to the other; `p`: two-sided, adjusted.
/// Significant is p < alpha.
Verdict difference_verdict(ledger::Relation relation, statistics::Direction direction, double p,
                           double alpha);

/// Of an interval and the claimed range, bounds included: wholly inside, wholly on one side, or across a
/// bound.
Verdict bounds_verdict(const statistics::Interval& interval, double at_least, double at_most);

/// Agreement with a published figure. Contradicted: a test finds a difference, p < alpha. Confirmed: it finds
/// none, and the published figure lies in our own confidence interval. Between the two: not confirmed.
Verdict agreement_verdict(double p, double alpha, bool inside);

/// Of a count of successes, when `missing` more runs are planned: they may all turn out either way. Not
/// testable while they could decide.
Verdict count_verdict(std::size_t successes, std::size_t missing, double at_least, double at_most);

/// Whether a gait's name is the one claimed: "walk" is "walk lateral" and "walk diagonal" too.
bool is_gait(std::string_view name, std::string_view claimed);

/// `occurring`: names of the regular gaits that occur. With runs `missing`, only what these cannot change is
/// decided. Not confirmed if all runs are in and no regular gait occurs.
Verdict gaits_verdict(const std::set<std::string>& occurring, const std::vector<std::string>& includes,
                      const std::vector<std::string>& only, bool missing);

}  // namespace amble::report
