#include "amble/report/transfer.hpp"

#include "amble/ledger/measures.hpp"
#include "amble/report/study_data.hpp"
#include "amble/statistics/descriptive.hpp"

namespace amble::report {
namespace {

/// The measure with which a foreign engine's distance is compared.
std::string reference_measure(const StudyData& data, const ledger::TestSpec& test,
                              const ledger::Record& run) {
  const auto* result = data.result(run, test.name);
  for (const ledger::TestSpec& other : data.study.tests) {
    const auto* at_home = data.result(run, other.name);
    if (at_home && at_home->engine == run.engine && at_home->trial_s == result->trial_s &&
        other.noise == test.noise && other.level == test.level && other.ground == test.ground &&
        other.damage == test.damage && other.command == test.command && other.episodes == test.episodes)
      return other.name + ".distance_m";
  }
  const bool as_in_evolution =
      !test.is_disturbed() && test.ground.empty() && test.damage.empty() && test.command.empty();
  return as_in_evolution && ledger::evolution_trial_s(run) == result->trial_s &&
                 ledger::objective_of(run).is_distance
             ? "train_m"
             : "";
}

std::optional<Transfer> transfer(const StudyData& data, const ledger::TestSpec& test,
                                 const std::string& condition) {
  Transfer found;
  found.test = test.name;
  found.condition = condition;
  std::vector<double> distances, shares;
  for (const ledger::Record* run : data.runs(condition)) {
    const auto* result = data.result(*run, test.name);
    if (result == nullptr || result->engine == run->engine) continue;
    found.home = run->engine;
    found.engine = result->engine;
    found.trial_s = result->trial_s;
    distances.push_back(result->distance_m());
    const std::string reference = reference_measure(data, test, *run);
    if (reference.empty()) continue;
    found.reference = reference;
    if (const double at_home = *ledger::measure(*run, reference); at_home > 0.0)
      shares.push_back(distances.back() / at_home);
  }
  if (distances.empty()) return std::nullopt;
  found.n = distances.size();
  found.median_m = statistics::median(distances);
  found.n_share = shares.size();
  if (!shares.empty()) found.share = statistics::median(shares);
  if (shares.size() >= fewest_resampled)
    found.share_interval = statistics::bootstrap(shares, statistics::median);
  return found;
}

}  // namespace

std::vector<Transfer> transfers(const StudyData& data) {
  std::vector<Transfer> all;
  for (const ledger::TestSpec& test : data.study.tests)
    for (const ledger::ConditionSpec& condition : data.study.conditions)
      if (auto found = transfer(data, test, condition.name)) all.push_back(std::move(*found));
  return all;
}

}  // namespace amble::report
