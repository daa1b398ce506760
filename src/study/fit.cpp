#include "amble/study/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/experiment/run_folder.hpp"

namespace amble::study {
namespace {

/// Why a record does not fit; empty if it does, or only lacks tests.
std::string record_misfit(const PlannedCondition& condition, const ledger::Record& record) {
  if (record.config != condition.hash) return "made with other settings or another robot";
  if (record.generations != condition.config.generations)
    return fmt::format("{} generations instead of {}", record.generations, condition.config.generations);
  for (const PlannedTest& test : condition.tests) {
    const auto* const result = record.find_test(test.spec.name);
    if (result != nullptr && result->settings != test.settings_hash(condition.config.engine))
      return fmt::format("the test '{}' was another one", test.spec.name);
  }
  return {};
}

std::string folder_misfit(const PlannedCondition& condition, const experiment::RunPaths& paths,
                          std::int64_t seed) {
  const auto config = experiment::load_config(paths.config, {});
  const auto robot = experiment::load_robot_file(paths.robot);
  if (config.seed != seed) return fmt::format("has the seed {}", config.seed);
  if (config_hash(config, robot) != condition.hash) return "made with other settings or another robot";
  if (config.generations != condition.config.generations)
    return fmt::format("{} generations instead of {}", config.generations, condition.config.generations);
  return {};
}

/// What the folders say of a run.
struct Finding {
  RunStatus status = RunStatus::missing;
  std::filesystem::path place;  ///< the record or the run folder; empty if missing
  std::string misfit;           ///< why it does not fit; empty if it does
};

Finding look_at(const Plan& plan, const ledger::Ledger& ledger, const PlannedRun& run) {
  const PlannedCondition& condition = plan.condition(run);
  if (ledger.has(condition.spec.name, run.seed)) {
    const auto record = ledger.load(condition.spec.name, run.seed);
    return {.status = condition.has_all_tests(record) ? RunStatus::done : RunStatus::untested,
            .place = plan.paths.record(condition.spec.name, run.seed),
            .misfit = record_misfit(condition, record)};
  }
  const auto folder = plan.folder(run);
  if (!experiment::is_run_folder(folder)) return {};
  try {
    auto misfit = folder_misfit(condition, experiment::RunPaths(folder), run.seed);
    return {.status = RunStatus::begun, .place = folder, .misfit = std::move(misfit)};
  } catch (const UserError&) {
    // Another process may have finished the run and removed its folder meanwhile.
    if (!ledger.has(condition.spec.name, run.seed)) throw;
    return look_at(plan, ledger, run);
  }
}

/// Names of runs, by condition and seed: "supg-001 to supg-020, sine-003".
std::string names_of(const Plan& plan, std::vector<PlannedRun> runs) {
  std::ranges::sort(runs, {}, [](const PlannedRun& run) { return std::pair(run.condition, run.seed); });
  const auto name = [&plan](const PlannedRun& run) { return plan.folder(run).filename().string(); };
  const auto follows = [](const PlannedRun& run, const PlannedRun& other) {
    return other.condition == run.condition && other.seed - 1 == run.seed;
  };
  std::string text;
  for (std::size_t first = 0, last = 0; first < runs.size(); first = last + 1) {
    last = first;
    while (last + 1 < runs.size() && follows(runs[last], runs[last + 1])) ++last;
    text += (text.empty() ? "" : ", ") + name(runs[first]);
    if (last > first) text += (last == first + 1 ? ", " : " to ") + name(runs[last]);
  }
  return text;
}

/// Runs that do not fit the study, by the folder that what is there of them is in, and the reason.
using Misfits = std::map<std::pair<std::string, std::string>, std::vector<PlannedRun>>;

[[noreturn]] void refuse(const Plan& plan, const Misfits& misfits) {
  std::size_t count = 0;
  std::string named;
  for (const auto& [where, runs] : misfits) {
    count += runs.size();
    named += fmt::format("{} in {} ({}); ", names_of(plan, runs), where.first, where.second);
  }
  fail(ExitCode::bad_input,
       "{} of {} runs no longer fit the study: {}nothing was changed; name another --out, or move them away",
       count, plan.runs.size(), named);
}

}  // namespace

std::vector<RunStatus> survey(const Plan& plan) {
  const ledger::Ledger ledger(plan.paths);
  std::vector<RunStatus> states;
  Misfits misfits;
  for (const PlannedRun& run : plan.runs) {
    const Finding found = look_at(plan, ledger, run);
    if (!found.misfit.empty()) misfits[{found.place.parent_path().string(), found.misfit}].push_back(run);
    states.push_back(found.status);
  }
  if (!misfits.empty()) refuse(plan, misfits);
  return states;
}

}  // namespace amble::study
