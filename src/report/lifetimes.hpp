#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "amble/report/study_data.hpp"
#include "amble/statistics/survival.hpp"

namespace amble::report {

/// The state of a champion whose duration is a lifetime, censored at the end of the test.
enum class Activity : std::uint8_t {
  upright,  ///< ends when the robot falls or its simulation diverges
  walking   ///< ends when it falls, diverges or stops (score/walking.hpp)
};
inline constexpr std::array<std::string_view, 2> activity_names{"upright", "walking"};

struct ConditionLifetimes {
  std::string condition;
  std::vector<statistics::Lifetime> lifetimes;  ///< of runs with the test, in the order of seeds
  statistics::SurvivalCurve curve;
};

/// Lifetimes of the champions of all conditions in one test.
struct SurvivalTable {
  std::string test;
  Activity activity = Activity::upright;
  double trial_s = 0.0;  ///< length of the test, at which lifetimes are censored
  bool is_long = false;  ///< longer than the trials of evolution, as far as these are known
  std::vector<ConditionLifetimes> conditions;  ///< that have the test
  /// Over `conditions`; none if fewer than two have the test or nothing ended.
  std::optional<statistics::LogRank> log_rank;
};

/// Both activities in every test that any run has. With several episodes in a test, a run's lifetime is that
/// of its middle episode, of an even number the shorter one of the two.
std::vector<SurvivalTable> survival_tables(const StudyData& data);

}  // namespace amble::report
