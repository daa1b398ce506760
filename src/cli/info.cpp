#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "amble/cli/compare.hpp"
#include "amble/cli/help.hpp"
#include "amble/cli/progress.hpp"
#include "amble/cli/stop_signal.hpp"
#include "amble/core/hash.hpp"
#include "amble/core/index.hpp"
#include "amble/cppn/reference.hpp"
#include "amble/experiment/champion.hpp"
#include "amble/experiment/corrected_map.hpp"
#include "amble/experiment/repertoire.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/experiment/typical.hpp"
#include "amble/io/file.hpp"
#include "amble/io/file_kind.hpp"
#include "amble/io/quoting.hpp"
#include "amble/io/text.hpp"
#include "amble/record/frame_codec.hpp"
#include "amble/record/generations_csv.hpp"
#include "amble/record/recording.hpp"

namespace amble::cli {
namespace {

/// Whether the CPPN's outputs at the points where the controller asks for them depend on the precision.
void print_sensitivity(const experiment::Champion& champion) {
  const auto& problem = champion.problem;
  const auto* const substrate = problem.architecture->substrate();
  if (substrate == nullptr) return;
  constexpr double noticeable = 0.01;
  const double largest = cppn::precision_sensitivity(champion.genome, problem.cppn, substrate->points());
  fmt::print("precision   outputs change by at most {:.2g} in double precision, at {} points{}\n", largest,
             substrate->points().count(),
             largest > noticeable ? ": a chaotic CPPN (docs/CONTROLLERS.md)" : "");
}

void print_champion(const experiment::Champion& champion) {
  const auto& problem = champion.problem;
  fmt::print("experiment  {} (seed {})\ngeneration  {}, genome {}\n", io::printable(champion.experiment),
             champion.seed, champion.generation, champion.index);
  fmt::print("robot       {}\ncontroller  {}\nengine      {}\n", problem.robot.name,
             problem.architecture->name(), problem.engine);
  fmt::print("CPPN        {} inputs, {} outputs, {} hidden nodes, {} links\n", problem.cppn_inputs(),
             problem.cppn_outputs(), champion.genome.count(neat::NodeKind::hidden),
             champion.genome.enabled_links());
  print_sensitivity(champion);
  fmt::print("result      {:.3f} m in {:.2f} s, {}\n", champion.result.distance_m, champion.result.seconds,
             record::outcome_names[to_index(champion.result.outcome)]);
  if (champion.result.score) fmt::print("score       {:.3f}\n", *champion.result.score);
  for (const auto& [engine, judged] : champion.referees)
    fmt::print("in {:<8} {}\n", engine, result_text(judged, champion.result.distance_m));
  if (champion.episodes.empty()) return;
  fmt::print("under noise {}, {} of",
             score::with_unit(fmt::format("{:.3f}", champion.objective()), problem.score),
             trial::episode_score_names[to_index(problem.noise.score)]);
  for (const auto& episode : champion.episodes) fmt::print(" {:.3f}", episode.result.value());
  fmt::print("\n");
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Wall time of a run by stage; of workers, the mean.
void print_stages(const record::Generations& rows) {
  const double wall_s = sum(rows.wall_s);
  if (wall_s <= 0.0 || rows.files_s.empty()) return;
  const auto print = [wall_s](std::string_view stage, double seconds) {
    fmt::print("  {:<24}{:>9.2f} s {:>5.1f} %\n", stage, seconds, 100.0 * seconds / wall_s);
  };
  fmt::print("time        {:.2f} s\n", wall_s);
  double rest_s = wall_s;
  const auto stage = [&](std::string_view name, const std::vector<double>& values) {
    print(name, sum(values));
    rest_s -= sum(values);
  };
  stage("physics", rows.physics_s);
  stage("genomes to controllers", rows.decode_s);
  stage("controllers, noise", rows.control_s);
  stage("waiting for others", rows.waiting_s);
  stage("search", rows.search_s);
  if (sum(rows.referees_s) > 0.0) stage("referees", rows.referees_s);
  stage("files", rows.files_s);
  print("overhead", std::max(0.0, rest_s));  // stages of neighbouring generations may overlap
}

/// A map's figures, and what they are in new trials if that takes seconds.
ExitCode print_map(const experiment::RunPaths& paths) {
  const auto repertoire = experiment::load_repertoire(paths);
  const auto& elites = repertoire.elites;
  const auto cells_text = [&](std::uint32_t filled) {
    return fmt::format("{} of {} cells, {:.1f} %", filled, elites.cells(), 100.0 * filled / elites.cells());
  };
  fmt::print("map         {}; QD score {:.2f}\n", cells_text(elites.size()), elites.objective_sum());
  if (!repertoire.problem.trials_vary() || elites.size() == 0) return ExitCode::ok;
  constexpr int trials = 20;
  constexpr std::uint32_t most_elites = 1000;
  if (elites.size() > most_elites) {
    fmt::print("corrected   `amble repertoire {} --retest {}` makes {} trials\n",
               io::shell_word(paths.folder.string()), trials, trials * elites.size());
    return ExitCode::ok;
  }
  constexpr int one_worker = 1;
  const auto corrected = experiment::correct_map(repertoire, trials, one_worker, stop_signal());
  if (!corrected) return ExitCode::interrupted;
  fmt::print(
      "corrected   {}; QD score {:.2f}; {:.1f} % of the elites stay in their cell ({} new trials each)\n",
      cells_text(corrected->filled()), corrected->qd_score(), 100.0 * corrected->staying_share(), trials);
  return ExitCode::ok;
}

ExitCode run_info(const std::filesystem::path& folder) {
  const experiment::RunPaths paths = experiment::find_run(folder);
  const auto config = experiment::load_config(paths.config, {});
  const auto rows = record::read_generations(paths.generations);
  double evaluations = 0.0, steps = 0.0;
  for (std::size_t i = 0; i < rows.count(); ++i) {
    evaluations += rows.evaluations[i];
    steps += rows.steps[i];
  }
  fmt::print("experiment  {} (seed {})\nengine      {}\ngenerations {} of {}\n", io::printable(config.name),
             config.seed, config.engine, rows.count(), config.generations);
  fmt::print("evaluations {:.0f} ({:.3g} steps)\n", evaluations, steps);
  fmt::print("search      {}", config.search.kind);
  if (experiment::fills_map(config))
    fmt::print(": `amble repertoire {}` shows the map", io::shell_word(folder.string()));
  if (!rows.archive.empty() && !rows.novelty_threshold.empty())
    fmt::print(": archive of {:.0f} behaviours, threshold {:.4g} in the last generation", rows.archive.back(),
               rows.novelty_threshold.back());
  fmt::print("\n");
  if (experiment::fills_map(config))
    if (const auto code = print_map(paths); code != ExitCode::ok) return code;
  print_stages(rows);
  if (!rows.typical.empty())
    fmt::print("typical     {}, half of {} trials {:.2f} to {:.2f}, {:.0f} % fell\n",
               score::with_unit(fmt::format("{:.2f}", rows.typical.back()), config.score),
               experiment::running_trials, rows.typical_lower.back(), rows.typical_upper.back(),
               100.0 * rows.typical_fell.back());
  const auto champions = paths.champion_files();
  fmt::print("champions   {}\n", champions.size());
  fmt::print("digest      {} (equal for equal results; times do not count)\n",
             hex(experiment::run_digest(paths)));
  if (!champions.empty()) {
    const auto best = paths.best_champion();
    fmt::print("\nbest: {}\n", best.string());
    print_champion(experiment::load_champion(best));
  }
  if (rows.count() < to_index(config.generations))
    fmt::print("\nto continue, run: amble resume {}\n", io::shell_word(folder.string()));
  return ExitCode::ok;
}

ExitCode recording_info(const std::filesystem::path& path) {
  record::RecordingReader reader(path);
  std::vector<float> frame;
  while (reader.next(frame)) {
  }
  fmt::print("recording of {}\n{} frames, {} s apart: {}\n{}\n{} columns:", reader.header().origin,
             reader.frames_read(), reader.header().frame_s,
             clock_text(static_cast<double>(reader.frames_read()) * reader.header().frame_s),
             record::outcome_names[to_index(reader.outcome())], reader.header().columns.size());
  for (const auto& column : reader.header().columns) fmt::print(" {}", column);
  fmt::print("\n");
  return ExitCode::ok;
}

ExitCode info(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) return run_info(path);
  if (io::file_kind(path) == io::FileKind::recording) return recording_info(path);
  print_champion(experiment::load_champion(path));
  return ExitCode::ok;
}

}  // namespace

void add_info(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("info", "Say what a run folder, champion or recording holds");
  auto path = std::make_shared<std::filesystem::path>();
  command->add_option("PATH", *path, "Run folder, champion file or recording")->required();
  add_examples(*command, {{"amble info runs/1", ""}});
  command->callback([path, &action] { action = [path] { return info(*path); }; });
}

}  // namespace amble::cli
