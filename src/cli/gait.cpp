#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "amble/cli/help.hpp"
#include "amble/cli/options.hpp"
#include "amble/cli/outputs.hpp"
#include "amble/cli/stop_signal.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/gait/recorded_gait.hpp"
#include "amble/gait/report_text.hpp"
#include "amble/io/file.hpp"
#include "amble/io/file_kind.hpp"
#include "amble/presentation/champion_gait.hpp"

namespace amble::cli {
namespace {

namespace fs = std::filesystem;

struct GaitOptions {
  fs::path path;
  std::optional<double> seconds;
  std::optional<std::string> engine;
  std::optional<std::string> json;
  gait::Settings settings;
  presentation::TrialChoice disturbance;
};

/// Runs a champion, in the median of several trials where it was evolved under noise, and measures its gait.
/// None if interrupted.
std::optional<gait::Report> champion_gait(const fs::path& path, const GaitOptions& options) {
  const auto champion = experiment::load_champion(path);
  check_seconds(options.seconds, champion.problem.trial);
  const auto walked =
      presentation::champion_gait(champion, path.string(), options.seconds, options.engine, options.settings,
                                  options.disturbance, processors(), stop_signal());
  if (!walked) return std::nullopt;
  if (!walked->shown.typical.empty() && options.json != "-")
    fmt::print("{}\nthe gait of {}:\n", walked->shown.typical,
               walked->shown.key ? "the median trial" : "its trial without noise");
  return walked->report;
}

std::optional<gait::Report> measure(const GaitOptions& options) {
  if (io::file_kind(options.path) != io::FileKind::recording)
    return champion_gait(experiment::champion_at(options.path), options);
  const bool disturbed = options.disturbance.asked() || options.disturbance.undisturbed;
  if (options.engine || disturbed) {
    fail(ExitCode::bad_input, "{}: {} has been made already",
         options.engine                    ? "--engine"
         : options.disturbance.undisturbed ? "--undisturbed"
                                           : "--level, --trials, --noise",
         options.path.string());
  }
  return gait::recorded_gait(options.path, options.settings, options.seconds);
}

ExitCode run_gait(const GaitOptions& options) {
  options.settings.validate();
  if (options.json && *options.json != "-") check_output(*options.json, gait::report_json_start, "a gait");
  const auto report = measure(options);
  if (!report) fail(ExitCode::interrupted, "stopped before the end of the trial");
  if (options.json == "-") {
    fmt::print("{}", gait::report_json(*report));
    return ExitCode::ok;
  }
  if (options.json) io::write_output(*options.json, gait::report_json(*report));
  fmt::print("{}", gait::report_table(*report));
  return ExitCode::ok;
}

}  // namespace

void add_gait(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("gait", "Name and measure a gait: footfalls, phases, speed, energy");
  auto options = std::make_shared<GaitOptions>();
  command->add_option("PATH", options->path, "Recording, champion file, or run folder (its best champion)")
      ->required();
  command
      ->add_option("--seconds", options->seconds,
                   "Length of the trial, s (default: as in its evolution), or of the part of a recording")
      ->check(seconds_check());
  add_engine(*command, options->engine, "Physics engine (default: as in its evolution)");
  add_disturbance(*command, options->disturbance);
  command->add_option("--json", options->json, "Write all figures to this file; - prints them instead");
  auto& settings = options->settings;
  command->add_option("--debounce", settings.debounce_s, "Shorter gaps and touches are chatter, s")
      ->capture_default_str();
  command->add_option("--transient", settings.transient_s, "Footfalls so early do not count, s")
      ->capture_default_str();
  command
      ->add_option(
          "--window", settings.window_s,
          "Least length of the windows in which the gait is classified; each has 4 strides of each foot, s")
      ->capture_default_str();
  add_examples(*command,
               {{"amble gait runs/1", ""},
                {"amble gait walk.rec --json gait.json", "of a recording by amble trial --record"}});
  command->callback([options, &action] { action = [options] { return run_gait(*options); }; });
}

}  // namespace amble::cli
