#include "amble/study/fit.hpp"

#include <fmt/format.h>

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
    return fmt::format("has {} generations instead of {}", record.generations, condition.config.generations);
  for (const PlannedTest& test : condition.tests) {
    const auto* const result = record.find_test(test.spec.name);
    if (result != nullptr && result->settings != test.settings_hash(condition.config.engine))
      return fmt::format("its test '{}' was another one", test.spec.name);
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
    return fmt::format("has {} generations instead of {}", config.generations, condition.config.generations);
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

}  // namespace

std::vector<RunStatus> survey(const Plan& plan) {
  const ledger::Ledger ledger(plan.paths);
  std::vector<RunStatus> states;
  std::vector<std::string> misfits;
  for (const PlannedRun& run : plan.runs) {
    const Finding found = look_at(plan, ledger, run);
    if (!found.misfit.empty()) misfits.push_back(fmt::format("{} ({})", found.place.string(), found.misfit));
    states.push_back(found.status);
  }
  if (!misfits.empty())
    fail(ExitCode::bad_input,
         "{} of {} runs no longer fit the study: {}{}; nothing was changed; name another --out, or move them "
         "away",
         misfits.size(), plan.runs.size(), misfits.front(),
         misfits.size() > 1 ? fmt::format(" and {} more", misfits.size() - 1) : "");
  return states;
}

}  // namespace amble::study
