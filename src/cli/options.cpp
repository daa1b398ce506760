#include "amble/cli/options.hpp"

#include <fmt/format.h>
#include <utility>

#include "amble/cli/stop_signal.hpp"
#include "amble/core/error.hpp"
#include "amble/record/levels.hpp"

namespace amble::cli {
namespace {

/// "own|control|micro|100-micro|milli".
std::string level_values() {
  std::string text(record::own_noise);
  for (const record::Level& level : record::levels()) text += fmt::format("|{}", level.name);
  return text;
}

}  // namespace

void check_seconds(std::optional<double> seconds, trial::Settings trial) {
  if (!seconds) return;
  trial.duration_s = *seconds;
  try {
    trial.validate();
  } catch (const SettingError&) {
    fail(ExitCode::bad_input, "--seconds {}: expected a whole number of timesteps of {} s", *seconds,
         trial.timestep_s);
  }
}

void add_disturbance(CLI::App& command, presentation::TrialChoice& choice, const std::string& by_default) {
  auto* const level =
      command
          .add_option("--level", choice.level,
                      "What disturbs the trials that tell what is typical (default: the noise of its "
                      "evolution, or, without any, " +
                          std::string(record::default_level) + ": starts that differ by a milli-radian)")
          ->type_name(level_values());
  auto* const noise =
      command
          .add_option("--noise", choice.noise,
                      "Disturb these trials by the [noise] of this config file in place of a level")
          ->excludes(level);
  auto* const trials = command
                           .add_option("--trials", choice.trials,
                                       fmt::format("Number of these trials (default: {})", by_default))
                           ->check(between(1, presentation::most_typical_trials));
  command.add_flag("--undisturbed", choice.undisturbed, "The one trial without noise instead")
      ->excludes(level)
      ->excludes(noise)
      ->excludes(trials);
}

presentation::ShownTrial shown_trial(const experiment::Champion& champion, std::optional<double> seconds,
                                     const std::optional<std::string>& engine,
                                     const presentation::TrialChoice& choice) {
  auto shown = presentation::shown_trial(champion, seconds, engine, choice, processors(), stop_signal());
  if (!shown) fail(ExitCode::interrupted, "stopped before the end of the trials");
  return std::move(*shown);
}

}  // namespace amble::cli
