#include "amble/experiment/run.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/experiment/replay.hpp"
#include "amble/score/distance.hpp"
#include "amble/score/path_behaviour.hpp"

namespace amble::experiment {
namespace {

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Throws UserError rather than being killed for it after hours.
void check_memory(const Config& config) {
  if (config.search.kind == search::Kind::novelty)
    config.search.novelty.check_memory(config.behaviour_length(), config.neat.population.size,
                                       search::machine_memory_bytes());
}

/// Throws UserError before anything is written.
void complain_early(const Config& config, const morphology::RobotSpec& robot) {
  auto problem = Problem::make(config, robot);
  for (const auto& referee : config.referees) {
    problem.engine = referee;
    problem.make_engine();
  }
}

/// Returns how many bytes of the file the search has taken back; nothing if it keeps no archive.
std::optional<std::uint64_t> restore_archive(const std::filesystem::path& path, search::Search& search) {
  if (!search.has_archive()) return std::nullopt;
  if (!std::filesystem::exists(path))
    fail(ExitCode::bad_file, "{}: missing; the run cannot go on without it", path.string());
  io::InputFile file(path);
  return search.restore_archive(file, path.string());
}

}  // namespace

Run::Run(RunFolder folder, const Config& config, const morphology::RobotSpec& robot, int jobs)
    : folder_(std::move(folder)),
      config_(config),
      problem_(std::make_unique<const Problem>(Problem::make(config, robot))),
      population_(config.neat, problem_->cppn_inputs(), problem_->cppn_outputs(), config.cppn.recurrent,
                  static_cast<std::uint64_t>(config.seed)),
      search_(search::make_search(config.search, config.behaviour_length())),
      jobs_(jobs) {}

Run Run::start(const std::filesystem::path& folder, const Config& config, int jobs) {
  check_memory(config);
  const auto robot = load_robot_file(config.robot);
  complain_early(config, robot);
  Run run(RunFolder::create(folder, config, robot), config, robot, jobs);
  run.csv_ = std::make_unique<io::AppendFile>(run.paths().generations, 0);
  run.csv_->append(csv_header());
  if (run.search_->has_archive()) {
    run.archive_ = std::make_unique<io::AppendFile>(run.paths().archive, 0);
    run.archive_->append(run.search_->take_archive_growth());
  }
  run.checkpoint();
  run.folder_.note_process(config, jobs, 0);
  return run;
}

Run Run::resume(const std::filesystem::path& folder, std::optional<int> generations, int jobs) {
  auto held = RunFolder::open(folder);
  Config config = held.load_config();
  if (generations) config.generations = *generations;
  check_memory(config);
  const auto robot = held.load_robot();
  Run run(std::move(held), config, robot, jobs);
  run.progress_ = load_checkpoint(run.paths().checkpoint, config, run.population_, *run.search_);
  const auto archive_bytes = restore_archive(run.paths().archive, *run.search_);
  run.csv_ = std::make_unique<io::AppendFile>(run.paths().generations, run.progress_.csv_bytes);
  if (archive_bytes) run.archive_ = std::make_unique<io::AppendFile>(run.paths().archive, *archive_bytes);
  if (generations) run.folder_.save_config(config);
  run.folder_.note_process(config, jobs, run.generation());
  return run;
}

// The generation loop: evaluate, judge, keep the best, breed, write down.
RunStatus Run::execute(RunListener& listener, const std::atomic<bool>& stop) {
  Evaluator evaluator(*problem_, config_.search.path_stride(), jobs_);
  double last_row_s = now_s();
  while (population_.generation() < config_.generations) {
    const auto result = evaluator.evaluate(population_.genomes(), stop);
    if (!result) return RunStatus::interrupted;

    std::vector<double> distances_m;
    for (const auto& trajectory : result->trajectories) distances_m.push_back(score::distance_m(trajectory));
    const auto fitness = judge(*result, distances_m);

    GenerationRow row{.generation = population_.generation(),
                      .population = population_.statistics(),
                      .novelty = search_->novelty_statistics()};
    summarise_trials(distances_m, result->trajectories, row);
    const auto best = static_cast<std::size_t>(std::ranges::max_element(distances_m) - distances_m.begin());
    row.best_hidden = population_.genomes()[best].count(neat::NodeKind::hidden);
    row.best_links = population_.genomes()[best].enabled_links();
    row.evaluations = distances_m.size();
    row.steps = result->steps;
    row.physics_s = result->physics_s;
    if (row.best_m > progress_.best_m) row.physics_s += keep_champion(*result, best);
    row.best_so_far_m = progress_.best_m;

    population_.advance(fitness);

    row.wall_s = now_s() - std::exchange(last_row_s, now_s());
    row.outside_s = row.wall_s - row.physics_s;
    write_down(row);
    listener.on_generation(row, progress_, config_);
  }
  return RunStatus::finished;
}

std::vector<neat::Fitness> Run::judge(const GenerationResult& result, std::span<const double> distances_m) {
  const std::size_t length = config_.behaviour_length();
  std::vector<std::vector<float>> behaviours;
  std::vector<search::Evaluation> evaluations;
  for (std::size_t i = 0; i < distances_m.size(); ++i) {
    behaviours.push_back(score::path_behaviour(result.trajectories[i], length));
    evaluations.push_back({.objective = distances_m[i], .behaviour = behaviours.back()});
  }
  return search_->judge(evaluations);
}

double Run::keep_champion(const GenerationResult& result, std::size_t best) {
  static const std::atomic<bool> to_the_end{false};
  Champion champion{.experiment = config_.name,
                    .seed = config_.seed,
                    .generation = population_.generation(),
                    .index = static_cast<int>(best),
                    .problem = *problem_,
                    .genome = population_.genomes()[best],
                    .result = summarise(result.trajectories[best]),
                    .referees = {},
                    .trace = {}};
  const auto again = replay(*problem_, champion.genome, {}, to_the_end);
  if (again->result.distance_m != champion.result.distance_m)
    fail(ExitCode::differs,
         "generation {}: the champion walked {} m, and {} m when run again: the engine does not repeat",
         champion.generation, champion.result.distance_m, again->result.distance_m);
  champion.trace = again->trace;
  double physics_s = again->physics_s;
  for (const auto& engine : config_.referees) {
    const auto elsewhere = replay(*problem_, champion.genome, {.engine = engine}, to_the_end);
    champion.referees.push_back({engine, elsewhere->result});
    physics_s += elsewhere->physics_s;
  }
  folder_.save_champion(champion);
  progress_.best_m = champion.result.distance_m;
  progress_.best_generation = champion.generation;
  return physics_s;
}

void Run::write_down(const GenerationRow& row) {
  progress_.evaluations += row.evaluations;
  progress_.steps += row.steps;
  progress_.wall_s += row.wall_s;
  csv_->append(csv_line(row));
  progress_.csv_bytes = csv_->size();
  // What the checkpoint counts on must be on the disk before it.
  if (archive_) archive_->append(search_->take_archive_growth());
  checkpoint();
}

void Run::checkpoint() const {
  save_checkpoint(paths().checkpoint, config_, progress_, population_, *search_);
}

}  // namespace amble::experiment
