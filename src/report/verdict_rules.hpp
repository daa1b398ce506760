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
#include "amble/statistics/descriptive.hpp"

namespace amble::report {

/// The verdict on a claim. The rules are in docs/STUDIES.md; whoever changes what they say of any data gives
/// ledger::current_rules a new number.
enum class Verdict : std::uint8_t {
  confirmed,
  compatible,  ///< the data do not contradict it, which is not evidence for it
  not_confirmed,
  contradicted,
  not_testable
};
inline constexpr std::array<std::string_view, 5> verdict_names{"confirmed", "compatible", "not confirmed",
                                                               "contradicted", "not testable"};
inline std::string_view name_of(Verdict verdict) {
  return verdict_names[to_index(verdict)];
}

/// `direction`: where the condition's sample lies with respect to the other; `p`: two-sided, adjusted.
/// Significant is p < alpha. `not_inferior`: a test shows that the condition is not worse by more than the
/// margin that a claim of not_less states. Without that only a significantly better condition confirms such a
/// claim; one that is better or equal without significance is compatible with it.
Verdict difference_verdict(ledger::Relation relation, statistics::Direction direction, double p, double alpha,
                           bool not_inferior = false);

/// The verdict on an interval and the claimed range, bounds included: wholly inside, wholly on one side, or
/// across a bound.
Verdict bounds_verdict(const statistics::Interval& interval, double at_least, double at_most);

/// How our runs compare with a published figure.
struct Agreement {
  double p = 1.0;               ///< of the test that finds a difference
  double alpha = 0.05;          ///< its level
  bool inside = false;          ///< whether the published figure lies in our own confidence interval
  bool spreads_differ = false;  ///< significantly
  bool equivalent = false;      ///< whether a test shows that the two differ by less than a margin
};
/// Contradicted: a test finds a difference, p < alpha. Not confirmed: it finds none, but the published figure
/// lies outside our interval, or the spreads differ. Else compatible, and confirmed if equivalence is shown.
Verdict agreement_verdict(const Agreement& agreement);

/// The verdict on a count of successes, when `missing` more runs are planned: they may all turn out either
/// way. Not testable while they could decide.
Verdict count_verdict(std::size_t successes, std::size_t missing, double at_least, double at_most);

/// Whether a gait's name is the one claimed: "walk" is "walk lateral" and "walk diagonal" too.
bool is_gait(std::string_view name, std::string_view claimed);

/// `occurring`: names of the regular gaits that occur. With runs `missing`, only what these cannot change is
/// decided. Not confirmed if all runs are in and no regular gait occurs.
Verdict gaits_verdict(const std::set<std::string>& occurring, const std::vector<std::string>& includes,
                      const std::vector<std::string>& only, bool missing);

}  // namespace amble::report
