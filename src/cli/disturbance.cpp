#include "amble/cli/disturbance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "amble/cli/option_checks.hpp"
#include "amble/cli/stop_signal.hpp"
#include "amble/core/error.hpp"
#include "amble/record/levels.hpp"

namespace amble::cli {
namespace {

constexpr int most_trials = 100000;

/// "own|control|micro|100-micro|milli".
std::string level_values() {
  std::string text(experiment::own_noise);
  for (const record::Level& level : record::levels()) text += fmt::format("|{}", level.name);
  return text;
}

}  // namespace

void add_disturbance(CLI::App& command, DisturbanceOptions& options) {
  auto* const level =
      command
          .add_option("--level", options.level,
                      "What disturbs the trials that tell what is typical (default: the noise of its "
                      "evolution, or, without any, " +
                          std::string(record::default_level) + ": starts that differ by a milli-radian)")
          ->type_name(level_values());
  auto* const trials =
      command
          .add_option("--trials", options.trials,
                      "Number of these trials (default: 64, or 16 in engines that run one at a time)")
          ->check(between(1, most_trials));
  command.add_flag("--undisturbed", options.undisturbed, "The one trial without noise instead")
      ->excludes(level)
      ->excludes(trials);
}

experiment::TypicalTrials typical_trials(const experiment::Champion& champion,
                                         const experiment::Problem& problem,
                                         const DisturbanceOptions& options) {
  const int trials = options.trials > 0 ? options.trials : experiment::reported_trials(problem.engine);
  return {problem, champion.seed, trials, options.level, processors()};
}

ShownTrial shown_trial(const experiment::Champion& champion, std::optional<double> seconds,
                       const std::optional<std::string>& engine, const DisturbanceOptions& options) {
  const bool evolved_under_noise = champion.problem.disturbed();
  if (options.undisturbed || (!options.asked() && !evolved_under_noise))
    return {.noise = champion.problem.noise, .key = {}, .typical = {}};
  experiment::Problem problem = champion.problem;
  if (seconds) problem.trial.duration_s = *seconds;
  if (engine) problem.engine = *engine;
  problem.trial.validate();
  auto trials = typical_trials(champion, problem, options);
  const auto median = experiment::median_trial(trials, champion.genome, champion.seed, stop_signal());
  if (!median) fail(ExitCode::interrupted, "stopped before the end of the trials");
  return {.noise = median->problem.noise,
          .key = median->key,
          .typical = experiment::typical_text(median->distance, {}, problem.trial.duration_s, median->under)};
}

int processors() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace amble::cli
