#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "amble/report/study_data.hpp"
#include "amble/report/verdict_rules.hpp"
#include "amble/score/walking.hpp"

namespace amble::report {

/// Who walks on depends on what a stop is, a choice of ours. These are the rule of the ledgers (10 s within
/// 0.25 m, score/walking.hpp), its window and its radius varied one at a time, and a slow and wide one.
inline constexpr std::array<score::StandingRule, 9> stop_rules{{{5.0, 0.25},
                                                                {10.0, 0.1},
                                                                {10.0, 0.25},
                                                                {10.0, 0.5},
                                                                {10.0, 1.0},
                                                                {20.0, 0.25},
                                                                {30.0, 0.25},
                                                                {60.0, 0.25},
                                                                {60.0, 1.0}}};
/// The rule of the ledgers among them.
inline constexpr std::size_t ledger_stop_rule = 2;
static_assert(stop_rules[ledger_stop_rule].window_s == score::StandingRule{}.window_s &&
              stop_rules[ledger_stop_rule].radius_m == score::StandingRule{}.radius_m);

/// Seconds of walking in the first episode of a test by another rule, from the path in its record. A window
/// begins at each sample of the path, of which there is one per path_interval_s; score::WalkingMeter looked
/// ten times a second, so the two can differ: between samples a robot may leave the radius, or begin a
/// window. None if the samples are too far apart for the window (fewer than five intervals in it).
std::optional<double> walking_by_path_s(const ledger::TestResult& test, const score::StandingRule& rule);

/// How many champions of a condition walk for so long, by each of `stop_rules`.
struct StopCounts {
  std::string test, condition;
  double at_least_s = 0.0;
  std::optional<std::size_t> claim = {};  ///< index of the claim that counts them; none: the whole test
  std::size_t n = 0;                      ///< champions with a path
  std::size_t metered = 0;                ///< of these by score::WalkingMeter, in the first episode
  /// None by a rule whose window is longer than the test: in it nobody can stop.
  std::array<std::optional<std::size_t>, stop_rules.size()> runs{};
  std::array<Verdict, stop_rules.size()> verdicts{};  ///< on the claim, if there is one; only where `runs` is

  std::size_t fewest() const;
  std::size_t most() const;
};

/// The counts of all conditions in tests longer than the trials of evolution, each followed by the claims
/// that count walkers in them.
std::vector<StopCounts> stop_counts(const StudyData& data);

}  // namespace amble::report
