#include "amble/analysis/page.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "amble/analysis/figures.hpp"
#include "amble/cli/commands.hpp"
#include "amble/cli/compare_table.hpp"
#include "amble/cli/scratch_file.hpp"
#include "amble/cli/stop_signal.hpp"
#include "amble/experiment/build_info.hpp"
#include "amble/experiment/replay.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/io/file.hpp"

namespace amble::cli {
namespace {

namespace fs = std::filesystem;

struct PageOptions {
  fs::path run, out;
  std::optional<fs::path> figures;
  std::optional<std::string> engine;
};

std::string noise_text(const trial::NoiseSettings& noise) {
  if (!noise.any()) return "none";
  return fmt::format("{} of {} episodes; what is shown walked without",
                     trial::episode_score_names[static_cast<std::size_t>(noise.score)], noise.episodes);
}

std::vector<analysis::Fact> facts(const experiment::Config& config, const experiment::Champion& champion,
                                  const std::string& shown_in) {
  const auto build = experiment::build_info();
  const auto& robot = champion.problem.robot;
  std::vector<analysis::Fact> facts{
      {"Robot",
       fmt::format("{}, {:.1f} kg, {} motors", robot.name, robot.total_mass_kg(), robot.joints.size())},
      {"Engine", fmt::format("{}, steps of {} s", config.engine, config.trial.timestep_s)},
      {"Controller", champion.problem.architecture->name()},
      {"Population",
       fmt::format("{} genomes, {} generations", config.neat.population.size, config.generations)},
      {"Trial", fmt::format("{} s, or until the robot falls", config.trial.duration_s)},
      {"Noise", noise_text(config.noise)},
      {"Seed", fmt::format("{}", config.seed)},
      {"Champion", fmt::format("generation {}, genome {}: {:.3f} m in the engine {}", champion.generation,
                               champion.index, champion.result.distance_m, config.engine)},
      {"Shown", fmt::format("as it walks in the engine {}", shown_in)},
      {"Made by",
       fmt::format("amble {} ({}), {}", build.version, experiment::short_commit(build), build.compiler)}};
  for (const auto& [engine, judged] : champion.referees)
    facts.insert(facts.end() - 1,
                 {"In the engine " + engine, result_text(judged, champion.result.distance_m)});
  return facts;
}

ExitCode make_page(const PageOptions& options) {
  const experiment::RunPaths paths = experiment::find_run(options.run);
  io::refuse_to_replace(options.out, "<!DOCTYPE html>", "a page");
  if (options.figures) {
    fs::create_directories(*options.figures);
    for (const auto name : analysis::figure_names)
      io::refuse_to_replace(*options.figures / name, "<svg", "a figure");
  }
  const auto config = experiment::load_config(paths.config, {});
  const auto champion_path = paths.best_champion();
  const auto champion = experiment::load_champion(champion_path);

  const ScratchFile recording("walk.rec");
  const auto replay = experiment::replay(champion.problem, champion.genome,
                                         {.seconds = {},
                                          .engine = options.engine,
                                          .record = recording.path(),
                                          .origin = champion_path.string(),
                                          .noise = {}},
                                         stop_signal());
  if (!replay) fail(ExitCode::interrupted, "stopped before the champion had walked");

  const analysis::PageInput input{
      .title = config.name,
      .subtitle = fmt::format("the champion of {} generations of {}, evolved by amble",
                              champion.generation + 1, config.neat.population.size),
      .generations = analysis::read_generations(paths.generations),
      .recording = recording.path(),
      .cppn =
          analysis::CppnSize{champion.genome.count(neat::NodeKind::hidden), champion.genome.enabled_links()},
      .facts = facts(config, champion, options.engine.value_or(config.engine)),
      .commands = {fmt::format("amble evolve {} --out AGAIN", paths.config.string()),
                   fmt::format("amble page AGAIN{} -o page.html",
                               options.engine ? " --engine " + *options.engine : "")}};
  const auto recorded = analysis::read_recorded(recording.path());
  if (options.out.has_parent_path()) fs::create_directories(options.out.parent_path());
  io::write_file(options.out, analysis::make_page(input, recorded));
  if (options.figures)
    for (const auto& figure : analysis::figure_files(input, recorded))
      io::write_file(*options.figures / figure.name, figure.svg);
  fmt::print("{}\n", fs::absolute(options.out).lexically_normal().string());
  return ExitCode::ok;
}

}  // namespace

void add_page(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("page", "Make a page with figures of a run and its champion");
  auto options = std::make_shared<PageOptions>();
  command->add_option("DIR", options->run, "Run folder")->required();
  command->add_option("-o,--out", options->out, "The page to write (HTML)")->required();
  command->add_option("--figures", options->figures,
                      "Also write each figure as an SVG file into this folder");
  command->add_option("--engine", options->engine,
                      "Physics engine in which the champion is shown (default: as in its evolution)");
  command->callback([options, &action] { action = [options] { return make_page(*options); }; });
}

}  // namespace amble::cli
