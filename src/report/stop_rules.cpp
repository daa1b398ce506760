#include "amble/report/stop_rules.hpp"

#include <algorithm>
#include <cmath>

#include "amble/core/index.hpp"
#include "amble/ledger/measures.hpp"
#include "amble/report/verdict.hpp"

namespace amble::report {
namespace {

// Times are sums of steps; what ends this close to the end of a test lasted.
constexpr double stop_time_slack = 1e-9;
constexpr double fewest_intervals = 5.0;

struct Place {
  double x_m = 0.0, y_m = 0.0;
};

/// Whether all of so many samples after the first one are within the radius of it.
bool stays(const std::vector<Place>& path, std::size_t first, std::size_t window, double radius_m) {
  for (std::size_t i = first + 1; i <= first + window; ++i)
    if (std::hypot(path[i].x_m - path[first].x_m, path[i].y_m - path[first].y_m) > radius_m) return false;
  return true;
}

/// Results of a test longer than the trials of evolution, of the runs of a condition.
std::vector<const ledger::TestResult*> long_results(const StudyData& data, const std::string& condition,
                                                    const std::string& test) {
  std::vector<const ledger::TestResult*> results;
  for (const ledger::Record* run : data.runs(condition))
    if (const auto* result = data.result(*run, test);
        result != nullptr && result->trial_s > ledger::evolution_trial_s(*run).value_or(0.0) &&
        walking_by_path_s(*result, stop_rules.front()))
      results.push_back(result);
  return results;
}

std::size_t count_from(const std::vector<double>& values, double at_least) {
  return to_index(std::ranges::count_if(
      values, [at_least](double value) { return value >= at_least * (1.0 - stop_time_slack); }));
}

/// The counts of a condition; with the verdicts on a claim, if that is what they are for.
StopCounts count_stops(const StudyData& data, const std::vector<const ledger::TestResult*>& results,
                       StopCounts counts) {
  counts.n = results.size();
  std::vector<double> metered_s;
  metered_s.reserve(results.size());
  for (const auto* result : results) metered_s.push_back(result->episodes.front().walking_s);
  counts.metered = count_from(metered_s, counts.at_least_s);
  for (std::size_t rule = 0; rule < stop_rules.size(); ++rule) {
    if (stop_rules[rule].window_s > results.front()->trial_s) continue;  // nobody can stop for so long
    std::vector<double> walking_s;
    walking_s.reserve(results.size());
    for (const auto* result : results) walking_s.push_back(*walking_by_path_s(*result, stop_rules[rule]));
    counts.runs[rule] = count_from(walking_s, counts.at_least_s);
    if (counts.claim)
      counts.verdicts[rule] = judge_count_of(data, data.study.claims[*counts.claim], walking_s).verdict;
  }
  return counts;
}

}  // namespace

std::optional<double> walking_by_path_s(const ledger::TestResult& test, const score::StandingRule& rule) {
  if (test.path_interval_s <= 0.0 ||
      rule.window_s < fewest_intervals * test.path_interval_s * (1.0 - stop_time_slack))
    return std::nullopt;
  std::vector<Place> path{{}};  // the start, from which the record's path counts
  for (std::size_t i = 0; i + 1 < test.path_m.size(); i += 2)
    path.push_back({test.path_m[i], test.path_m[i + 1]});
  const auto window = static_cast<std::size_t>(std::llround(rule.window_s / test.path_interval_s));
  for (std::size_t first = 0; first + window < path.size(); ++first)
    if (stays(path, first, window, rule.radius_m)) return test.path_interval_s * static_cast<double>(first);
  return test.episodes.front().seconds;
}

std::size_t StopCounts::fewest() const {
  std::size_t least = n;
  for (const auto& count : runs) least = std::min(least, count.value_or(n));
  return least;
}

std::size_t StopCounts::most() const {
  std::size_t most = 0;
  for (const auto& count : runs) most = std::max(most, count.value_or(0));
  return most;
}

std::vector<StopCounts> stop_counts(const StudyData& data) {
  std::vector<StopCounts> all;
  for (const ledger::TestSpec& test : data.study.tests)
    for (const ledger::ConditionSpec& condition : data.study.conditions) {
      const auto results = long_results(data, condition.name, test.name);
      if (results.empty()) continue;
      all.push_back(
          count_stops(data, results,
                      {.test = test.name, .condition = condition.name, .at_least_s = results[0]->trial_s}));
      for (std::size_t i = 0; i < data.study.claims.size(); ++i) {
        const ledger::ClaimSpec& claim = data.study.claims[i];
        if (claim.kind == ledger::ClaimKind::count && claim.condition == condition.name &&
            claim.measure == test.name + ".walking_s" && claim.threshold_condition.empty())
          all.push_back(count_stops(
              data, results,
              {.test = test.name, .condition = condition.name, .at_least_s = claim.threshold, .claim = i}));
      }
    }
  return all;
}

}  // namespace amble::report
