#include "amble/cli/static_view.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "amble/cli/compare.hpp"
#include "amble/cli/help.hpp"
#include "amble/cli/messages.hpp"
#include "amble/cli/options.hpp"
#include "amble/cli/outputs.hpp"
#include "amble/cli/stop_signal.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/build_info.hpp"
#include "amble/experiment/replay.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/io/file.hpp"
#include "amble/io/quoting.hpp"
#include "amble/page/run_page.hpp"

namespace amble::cli {
namespace {

namespace fs = std::filesystem;

std::string noise_text(const trial::NoiseSettings& noise) {
  if (!noise.any()) return "none";
  return fmt::format("{} of {} episodes", trial::episode_score_names[to_index(noise.score)], noise.episodes);
}

std::vector<page::Fact> facts(const experiment::Config& config, const experiment::Champion& champion,
                              const std::string& shown_in, const presentation::ShownTrial& shown) {
  const auto build = experiment::build_info();
  const auto& robot = champion.problem.robot;
  std::vector<page::Fact> facts{
      {"Robot",
       fmt::format("{}, {:.1f} kg, {} motors", robot.name, robot.total_mass_kg(), robot.joints.size())},
      {"Engine", fmt::format("{}, steps of {} s", config.engine, config.trial.timestep_s)},
      {"Controller", champion.problem.architecture->name()},
      {"Population", fmt::format("{} genomes, {} generations", experiment::candidates_per_generation(config),
                                 config.generations)},
      {"Trial", fmt::format("{} s, or until the robot falls", config.trial.duration_s)},
      {"Noise", noise_text(config.noise)},
      {"Seed", fmt::format("{}", config.seed)},
      {"Champion",
       fmt::format("generation {}, genome {}: {:.3f} m in the engine {} without noise", champion.generation,
                   champion.index, champion.result.distance_m, config.engine)},
      {"Shown", fmt::format("as it walks in the engine {}, {}", shown_in,
                            shown.key ? "the median of these trials" : "without noise")},
      {"Made by",
       fmt::format("amble {} ({}), {}", build.version, experiment::short_commit(build), build.compiler)}};
  if (!shown.typical.empty()) facts.insert(facts.end() - 2, {"Typical", shown.typical});
  for (const auto& [engine, judged] : champion.referees)
    facts.insert(facts.end() - 1,
                 {"In the engine " + engine, result_text(judged, champion.result.distance_m)});
  return facts;
}

void check_outputs(const StaticView& options) {
  check_output(options.out, "<!DOCTYPE html>", "a page");
  if (!options.figures) return;
  for (const auto name : page::figure_names) {
    check_distinct({{"--out", options.out}, {"--figures", *options.figures / name}});
    check_output(*options.figures / name, "<svg", "a figure");
  }
}

/// Runs the champion again and reads what was recorded.
motion::RecordedTrial record_again(const experiment::Champion& champion, const fs::path& champion_path,
                                   const std::optional<std::string>& engine,
                                   const std::optional<trial::ScenarioKey>& noise) {
  const io::ScratchFile recording("walk.rec");
  const auto replay = experiment::replay(champion.problem, champion.genome,
                                         {.seconds = {},
                                          .engine = engine,
                                          .record = recording.path(),
                                          .origin = champion_path.string(),
                                          .noise = noise},
                                         stop_signal());
  if (!replay) fail(ExitCode::interrupted, "stopped before the champion had walked");
  return motion::read_recorded_trial(recording.path());
}

/// Those that say which trial is shown, as they are typed.
std::string options_text(const StaticView& options) {
  const presentation::TrialChoice& choice = options.disturbance;
  std::string text = options.engine ? " --engine " + *options.engine : "";
  if (!choice.level.empty()) text += " --level " + io::shell_word(choice.level);
  if (choice.noise) text += " --noise " + io::shell_word(choice.noise->string());
  if (choice.trials > 0) text += fmt::format(" --trials {}", choice.trials);
  return choice.undisturbed ? text + " --undisturbed" : text;
}

page::RunPage page_of(const experiment::RunPaths& paths, const experiment::Config& config,
                      const experiment::Champion& champion, const StaticView& options,
                      const presentation::ShownTrial& shown) {
  const auto generations = record::read_generations(paths.generations);
  return {
      .title = config.name,
      .subtitle = fmt::format(
          "the champion of {} generations of {}, found in generation {}; evolved by amble",
          generations.count(), experiment::candidates_per_generation(config), champion.generation),
      .generations = generations,
      .objective = score::objective_of(config.score),
      .cppn = page::CppnSize{champion.genome.count(neat::NodeKind::hidden), champion.genome.enabled_links()},
      .facts = facts(config, champion, options.engine.value_or(config.engine), shown),
      .commands = {fmt::format("amble evolve {} --out AGAIN", io::shell_word(paths.config.string())),
                   fmt::format("amble view AGAIN --static{} -o page.html", options_text(options))}};
}

}  // namespace

ExitCode make_static_view(const StaticView& options) {
  stop_signal();  // from here on what is in the folder for temporary files is removed
  const experiment::RunPaths paths = experiment::find_run(options.run);
  check_outputs(options);
  const auto config = experiment::load_config(paths.config, {});
  const auto champion_path = paths.best_champion();
  auto champion = experiment::load_champion(champion_path);
  const auto shown = shown_trial(champion, {}, options.engine, options.disturbance);
  champion.problem.noise = shown.noise;
  const auto recorded = record_again(champion, champion_path, options.engine, shown.key);
  const page::RunPage contents = page_of(paths, config, champion, options, shown);

  io::write_output(options.out, page::make_page(contents, recorded));
  if (options.figures)
    for (const auto& figure : page::figure_files(contents, recorded))
      io::write_output(*options.figures / figure.name, figure.svg);
  fmt::print("{}\n", fs::absolute(options.out).lexically_normal().string());
  return ExitCode::ok;
}

void add_page(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("page", "The same as amble view DIR --static");
  auto options = std::make_shared<StaticView>();
  command->add_option("DIR", options->run, "Run folder")->required();
  command->add_option("-o,--out", options->out, "The page to write (HTML)")->required();
  command->add_option("--figures", options->figures,
                      "Also write each figure as an SVG file into this folder");
  add_disturbance(*command, options->disturbance);
  add_engine(*command, options->engine,
             "Physics engine in which the champion is shown (default: as in its evolution)");
  add_examples(*command,
               {{"amble page runs/1 -o figures.html", "amble view runs/1 --static -o figures.html"}});
  command->callback([options, &action] {
    action = [options] {
      const ExitCode code = make_static_view(*options);
      print_message("amble page DIR: now written amble view DIR --static\n");
      return code;
    };
  });
}

}  // namespace amble::cli
