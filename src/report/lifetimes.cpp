#include "amble/report/lifetimes.hpp"

#include <algorithm>

#include "amble/ledger/measures.hpp"
#include "amble/report/study_data.hpp"

namespace amble::report {
namespace {

// Times are sums of steps; what ends this close to the end of a test lasted.
constexpr double slack = 1e-9;

/// The lifetime in the middle episode: of an even number the shorter of the two in the middle, because a mean
/// of one that ended and one that lasted is the time of neither.
statistics::Lifetime lifetime(const ledger::TestResult& result, Activity activity) {
  std::vector<double> times_s;
  for (const ledger::EpisodeResult& episode : result.episodes)
    times_s.push_back(activity == Activity::upright ? episode.seconds : episode.walking_s);
  std::ranges::sort(times_s);
  const double time_s = times_s.at((times_s.size() - 1) / 2);
  return {.time_s = time_s, .ended = time_s < result.trial_s * (1.0 - slack)};
}

SurvivalTable survival_table(const StudyData& data, const ledger::TestSpec& test, Activity activity) {
  SurvivalTable table{.test = test.name,
                      .activity = activity,
                      .trial_s = 0.0,
                      .is_long = false,
                      .conditions = {},
                      .log_rank = {}};
  for (const ledger::ConditionSpec& condition : data.study.conditions) {
    ConditionLifetimes lasted{.condition = condition.name, .lifetimes = {}, .curve = {}};
    for (const ledger::Record* run : data.runs(condition.name))
      if (const auto* result = data.result(*run, test.name)) {
        lasted.lifetimes.push_back(lifetime(*result, activity));
        table.trial_s = std::max(table.trial_s, result->trial_s);
        table.is_long = table.is_long || result->trial_s > ledger::evolution_trial_s(*run).value_or(0.0);
      }
    if (const auto curve = statistics::kaplan_meier(lasted.lifetimes, confidence)) {
      lasted.curve = *curve;
      table.conditions.push_back(std::move(lasted));
    }
  }
  std::vector<std::vector<statistics::Lifetime>> groups;
  for (const ConditionLifetimes& condition : table.conditions) groups.push_back(condition.lifetimes);
  table.log_rank = statistics::log_rank(groups);
  return table;
}

}  // namespace

std::vector<SurvivalTable> survival_tables(const StudyData& data) {
  std::vector<SurvivalTable> tables;
  for (const ledger::TestSpec& test : data.study.tests)
    for (const Activity activity : {Activity::upright, Activity::walking}) {
      SurvivalTable table = survival_table(data, test, activity);
      if (!table.conditions.empty()) tables.push_back(std::move(table));
    }
  return tables;
}

}  // namespace amble::report
