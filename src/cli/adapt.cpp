#include "amble/experiment/adapt.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "amble/cli/help.hpp"
#include "amble/cli/options.hpp"
#include "amble/cli/outputs.hpp"
#include "amble/cli/stop_signal.hpp"
#include "amble/experiment/given_damage.hpp"
#include "amble/io/file.hpp"
#include "amble/io/quoting.hpp"
#include "amble/presentation/adaptation_page.hpp"

namespace amble::cli {
namespace {

namespace fs = std::filesystem;

struct AdaptOptions {
  fs::path run;
  std::string damage;
  std::optional<fs::path> out;
  experiment::AdaptSettings settings;
  int jobs = 1;
};

void print(const experiment::Adaptation& adaptation, const experiment::Repertoire& repertoire,
           const AdaptOptions& options) {
  const auto text = [&](double value) {
    return score::with_unit(fmt::format("{:.3f}", value), repertoire.config.score);
  };
  fmt::print("{:>5} {:>8} {:>10} {:>20} {:>10}\n", "trial", "cell", "map says", "predicted", "measured");
  for (std::size_t i = 0; i < adaptation.steps.size(); ++i) {
    const auto& step = adaptation.steps[i];
    fmt::print("{:>5} {:>8} {:>10} {:>20} {:>10}\n", i + 1, step.cell, text(step.expected),
               fmt::format("{:.3f} ± {:.3f}", step.predicted, step.deviation), text(step.measured));
  }
  fmt::print("{} after {} trials{}\n\n", adaptation.done ? "nothing better is predicted" : "stopped",
             adaptation.steps.size(),
             options.settings.episodes > 1 ? fmt::format(" of {} attempts", options.settings.episodes) : "");
  if (repertoire.problem.trials_vary())
    fmt::print("in {}, means of {} trials:\n", options.settings.engine, options.settings.test_trials);
  else
    fmt::print("in {}, one trial each, as the map was made without noise:\n", options.settings.engine);
  fmt::print("  the map's best, intact     {}\n", text(adaptation.intact));
  fmt::print("  the same, damaged          {}\n", text(adaptation.damaged));
  fmt::print("  adapted (cell {:>6})      {}\n", adaptation.cell, text(adaptation.adapted));
  if (const double lost = adaptation.intact - adaptation.damaged; lost > 0.0)
    fmt::print("  loss recovered             {:.0f} %\n",
               100.0 * (adaptation.adapted - adaptation.damaged) / lost);
  fmt::print("\nthe gait found: amble repertoire {} --cell {} -o elite.json\n",
             io::shell_word(options.run.string()), adaptation.cell);
}

ExitCode run_adapt(AdaptOptions options) {
  const auto repertoire = experiment::load_repertoire(experiment::find_run(options.run));
  options.settings.damage = experiment::damage_of(options.damage);
  experiment::check_begins(options.settings.damage, repertoire.problem.trial.duration_s);
  const bool is_page = options.out && options.out->extension() == ".html";
  if (options.out && !is_page && options.out->extension() != ".json")
    fail(ExitCode::bad_input, "--out {}: expected FILE.html or FILE.json", options.out->string());
  if (is_page && repertoire.config.search.map_elites.archive != search::Archive::grid)
    fail(ExitCode::bad_input, "--out: a map of centroids has no picture: expected FILE.json");
  if (is_page)
    check_output(*options.out, "<!DOCTYPE html>", "a page");
  else if (options.out)
    check_output(*options.out, "{\n  \"format\": \"amble-adaptation\"", "an adaptation");
  const auto adaptation = experiment::adapt(repertoire, options.settings, options.jobs, stop_signal());
  if (!adaptation) return ExitCode::interrupted;
  if (is_page) {
    const auto page = presentation::adaptation_page(*adaptation, repertoire, options.settings, options.damage,
                                                    options.run, stop_signal());
    if (!page) return ExitCode::interrupted;
    io::write_output(*options.out, *page);
  } else if (options.out) {
    io::write_output(*options.out,
                     experiment::adaptation_json(*adaptation, repertoire, options.settings, options.damage));
  }
  print(*adaptation, repertoire, options);
  return ExitCode::ok;
}

}  // namespace

void add_adapt(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand(
      "adapt", "Let a damaged robot find a gait that works in a map, by intelligent trial and error");
  auto options = std::make_shared<AdaptOptions>();
  command->add_option("RUN", options->run, "Run folder of a search under MAP-Elites")->required();
  command
      ->add_option("--damage", options->damage,
                   "Such as missing:FL,weak:FR_knee=0.3, or a config with [damage] (docs/DAMAGE.md)")
      ->type_name("DAMAGE|FILE")
      ->required();
  command->add_option("--engine", options->settings.engine, "The engine that stands for reality")
      ->type_name(engine_values())
      ->capture_default_str();
  command->add_option("--trials", options->settings.most_trials, "Most trials of the search")
      ->check(between(1, 1000))
      ->capture_default_str();
  command
      ->add_option("--episodes", options->settings.episodes,
                   "Attempts under different noise whose mean is the result of one trial")
      ->check(between(1, 100))
      ->capture_default_str();
  command
      ->add_option("--noise-variance", options->settings.search.noise_variance,
                   "Variance of a trial (the mean of its episodes), as a share of the map's best squared "
                   "(0.001: trials nearly repeat; 0.01: they differ by a tenth of it)")
      ->check(between(1e-9, 1e3))
      ->capture_default_str();
  command
      ->add_option("--exploration", options->settings.search.exploration,
                   "Weight κ of the upper confidence bound (UCB) that chooses the next gait: standard "
                   "deviations by which an uncertain one counts as better")
      ->check(between(0.0, 1e3))
      ->capture_default_str();
  command
      ->add_option(
          "--length-scale", options->settings.search.length_scale,
          "Length scale ρ of the Matérn kernel, as a share of the map's dimensions: gaits farther apart tell "
          "little of each other")
      ->check(between(1e-3, 1e3))
      ->capture_default_str();
  command
      ->add_option("--stop-share", options->settings.search.stop_share,
                   "Stop when a gait that was tried is predicted to reach this share of the best; above 1: "
                   "use all trials")
      ->check(between(0.0, 10.0))
      ->capture_default_str();
  command
      ->add_option("--judge", options->settings.test_trials,
                   "Trials that judge a gait before and after, under noise of their own")
      ->check(between(1, 100000))
      ->capture_default_str();
  add_jobs(*command, options->jobs);
  command->add_option(
      "-o,--out", options->out,
      "FILE.html: a page with the map, the trials, and the elites that were tried; FILE.json: the "
      "steps and results");
  add_examples(*command, {{"amble adapt runs/map --damage missing:FL -o recovery.html", ""}});
  command->callback([options, &action] { action = [options] { return run_adapt(*options); }; });
}

}  // namespace amble::cli
