#pragma once

namespace amble::ledger {

/// Versions of what decides verdicts beside the claims themselves. StudySpec::claims_hash() covers them, so a
/// record tells under which rules its claims were written. docs/STUDIES.md lists what each version was;
/// tests/report/judging_rules_test.cpp fails if the rules' behaviour changes without a new number here.
struct JudgingRules {
  int verdicts = 0;  ///< report/verdict_rules.hpp, and what makes a claim not testable
  int stop = 0;      ///< score::StandingRule, and how score::WalkingMeter applies it

  friend bool operator==(const JudgingRules&, const JudgingRules&) = default;
};

/// Those that hashes without versions stand for: records made before the rules were part of the hash.
inline constexpr JudgingRules first_rules{.verdicts = 1, .stop = 1};
inline constexpr JudgingRules current_rules{.verdicts = 2, .stop = 1};

}  // namespace amble::ledger
