#include "amble/experiment/run.hpp"

#include <algorithm>
#include <utility>

#include "amble/core/clock.hpp"
#include "amble/core/error.hpp"
#include "amble/experiment/episodes.hpp"
#include "amble/experiment/referees.hpp"
#include "amble/experiment/replay.hpp"
#include "amble/score/path_behaviour.hpp"
#include "amble/search/usable_memory.hpp"

namespace amble::experiment {
namespace {

/// Throws UserError rather than being killed for it after hours.
void check_memory(const Config& config) {
  if (config.search.kind != search::Kind::novelty) return;
  try {
    config.search.novelty.check_memory(config.behaviour_length(), config.neat.population.size,
                                       search::usable_memory_bytes());
  } catch (const SettingError& error) {
    throw config.placed(error);
  }
}

/// Throws UserError if the run or one of its referees cannot be.
void complain_early(const Config& config, const robot::RobotSpec& robot) {
  auto problem = Problem::make(config, robot);
  for (const auto& referee : config.referees) {
    problem.engine = referee;
    try {
      problem.make_engine();
    } catch (const UserError& error) {
      fail(error.code(), "referees: {}", error.what());
    }
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

Run::Run(RunFolder folder, const Config& config, const robot::RobotSpec& robot, int jobs)
    : folder_(std::move(folder)),
      config_(config),
      problem_(std::make_unique<const Problem>(Problem::make(config, robot))),
      population_(config.neat, problem_->cppn_inputs(), problem_->cppn_outputs(), config.cppn.recurrent,
                  static_cast<std::uint64_t>(config.seed)),
      search_(search::make_search(config.search, config.behaviour_length())),
      jobs_(jobs) {}

Run Run::start(const std::filesystem::path& folder, const Config& config, int jobs) {
  check_memory(config);
  const auto robot = load_robot(config);
  complain_early(config, robot);  // before anything is written
  Run run(RunFolder::create(folder, robot), config, robot, jobs);
  run.csv_ = std::make_unique<io::AppendFile>(run.paths().generations, 0);
  run.csv_->append(csv_header());
  run.progress_.csv_bytes = run.csv_->size();
  if (run.search_->has_archive()) {
    run.archive_ = std::make_unique<io::AppendFile>(run.paths().archive, 0);
    run.archive_->append(run.search_->take_archive_growth());
  }
  save_checkpoint(run.paths().checkpoint, config, run.progress_, run.population_, *run.search_);
  run.folder_.note_process(config, jobs, 0);
  run.folder_.save_config(config);  // last: what has a config is a run
  return run;
}

Run Run::resume(const std::filesystem::path& folder, std::optional<int> generations, int jobs) {
  auto held = RunFolder::open(folder);
  Config config = held.load_config();
  if (generations) config.generations = *generations;
  check_memory(config);
  const auto robot = held.load_robot();
  Run run(std::move(held), config, robot, jobs);
  const auto archive_bytes = run.restore_newest();
  if (generations && *generations < run.generation())
    fail(ExitCode::bad_input, "{}: {} generations are done already, --generations {} asks for fewer",
         folder.string(), run.generation(), *generations);
  run.csv_ = std::make_unique<io::AppendFile>(run.paths().generations, run.progress_.csv_bytes);
  if (archive_bytes) run.archive_ = std::make_unique<io::AppendFile>(run.paths().archive, *archive_bytes);
  run.folder_.remove_leftovers();
  if (run.generation() < config.generations) run.folder_.note_process(config, jobs, run.generation());
  if (generations) run.folder_.save_config(config);
  return run;
}

std::optional<std::uint64_t> Run::restore(const std::filesystem::path& checkpoint) {
  search_ = search::make_search(config_.search, config_.behaviour_length());
  progress_ = load_checkpoint(checkpoint, config_, population_, *search_);
  return restore_archive(paths().archive, *search_);
}

std::optional<std::uint64_t> Run::restore_newest() {
  auto archive_bytes = restore(paths().checkpoint);
  const int named = generation();
  for (const auto& unnamed : unnamed_checkpoints(paths().checkpoint)) {
    try {
      const auto newer_bytes = restore(unnamed);
      // After a power cut the checkpoint may be on the disk and what it counts on may not.
      std::error_code error;
      const auto csv_bytes = std::filesystem::file_size(paths().generations, error);
      if (!error && csv_bytes >= progress_.csv_bytes && generation() > named) {
        check_best();
        io::write_file(paths().checkpoint, io::read_file(unnamed));
        return newer_bytes;
      }
    } catch (const UserError&) {
      // Cut off while it was written, or its archive was: the checkpoint before it counts.
    }
    archive_bytes = restore(paths().checkpoint);
  }
  check_best();
  return archive_bytes;
}

void Run::check_best() const {
  if (progress_.best_generation < 0) return;
  const auto file = paths().champion(progress_.best_generation);
  if (!std::filesystem::exists(file))
    fail(ExitCode::bad_file, "{}: missing, and it is the best of the run so far", file.string());
  const auto best = load_champion(file);
  if (best.generation != progress_.best_generation || best.seed != config_.seed ||
      best.objective_m() != progress_.best_m)
    fail(ExitCode::bad_file, "{}: not the champion that the run had there: that walked {} m, this one {} m",
         file.string(), progress_.best_m, best.objective_m());
}

RunStatus Run::execute(RunListener& listener, const std::atomic<bool>& stop) {
  const RunStatus status = generations(listener, stop);
  settle();
  return status;
}

// The generation loop: evaluate, judge, keep the best, breed, write down.
RunStatus Run::generations(RunListener& listener, const std::atomic<bool>& stop) {
  Evaluator evaluator(*problem_, config_.path_sampling(), jobs_);
  double last_row_s = now_s();
  while (population_.generation() < config_.generations) {
    const auto scenarios = problem_->scenarios(config_.seed, population_.generation());
    const auto result = evaluator.evaluate(population_.genomes(), stop, scenarios);
    if (!result) return RunStatus::interrupted;

    GenerationRow row;
    row.generation = population_.generation();
    row.population = population_.statistics();
    row.times = result->times;
    row.times.files_s = std::exchange(files_s_, 0.0);
    const auto distances_m = objectives_m(config_.noise.score, config_.trial.fall_factor, *result);
    const auto fitness = judge(*result, distances_m, row);
    summarise_trials(distances_m, result->trajectories, row);
    const auto best = static_cast<std::size_t>(std::ranges::max_element(distances_m) - distances_m.begin());
    row.best_hidden = population_.genomes()[best].count(neat::NodeKind::hidden);
    row.best_links = population_.genomes()[best].enabled_links();
    row.evaluations = distances_m.size();
    row.steps = result->steps;
    if (row.best_m > progress_.best_m && !keep_champion(best, row, stop)) return RunStatus::interrupted;
    row.best_so_far_m = progress_.best_m;

    breed(fitness, row);

    const double row_s = now_s();
    row.wall_s = row_s - std::exchange(last_row_s, row_s);
    write_down(row);
    listener.on_generation(row, progress_, config_);
  }
  return RunStatus::finished;
}

std::vector<neat::Fitness> Run::judge(const GenerationResult& result, std::span<const double> distances_m,
                                      GenerationRow& row) {
  const Stopwatch watch(row.times.judge_s);
  const std::size_t length = config_.behaviour_length();
  std::vector<std::vector<float>> behaviours;
  std::vector<search::Evaluation> evaluations;
  for (std::size_t i = 0; i < distances_m.size(); ++i) {
    // What it did is what it did in its first episode: a mean of paths would be nobody's path.
    behaviours.push_back(score::path_behaviour(result.of_genome(i).front(), length));
    evaluations.push_back({.objective = distances_m[i], .behaviour = behaviours.back()});
  }
  auto fitness = search_->judge(evaluations);
  row.novelty = search_->novelty_statistics();
  return fitness;
}

void Run::breed(std::span<const neat::Fitness> fitness, GenerationRow& row) {
  const Stopwatch watch(row.times.breed_s);
  population_.advance(fitness);
}

bool Run::keep_champion(std::size_t best, GenerationRow& row, const std::atomic<bool>& stop) {
  Champion champion{.experiment = config_.name,
                    .seed = config_.seed,
                    .generation = population_.generation(),
                    .index = static_cast<int>(best),
                    .problem = *problem_,
                    .genome = population_.genomes()[best],
                    .result = {},
                    .trace = {},
                    .episodes = {}};
  const auto undisturbed = replay(*problem_, champion.genome, {}, stop);
  if (!undisturbed) return false;
  champion.result = undisturbed->result;
  champion.trace = undisturbed->trace;
  row.times.physics_s += undisturbed->physics_s;
  if (problem_->noise.any())
    for (std::size_t i = 0; i < static_cast<std::size_t>(problem_->noise.episodes); ++i) {
      const auto again = replay(*problem_, champion.genome, {.noise = champion.scenario_key(i)}, stop);
      if (!again) return false;
      champion.episodes.push_back({again->result, again->trace});
      row.times.physics_s += again->physics_s;
    }
  if (champion.objective_m() != row.best_m)
    fail(ExitCode::differs,
         "generation {}: the champion walked {} m, and {} m when run again: the engine does not repeat",
         champion.generation, row.best_m, champion.objective_m());
  if (!config_.referees.empty()) {
    const Stopwatch watch(row.times.referees_s);
    auto judged = ask_referees(*problem_, champion.genome, config_.referees, jobs_, stop);
    if (!judged) return false;
    champion.referees = std::move(*judged);
  }
  {
    const Stopwatch watch(row.times.files_s);
    folder_.save_champion(champion);
  }
  progress_.best_m = row.best_m;
  progress_.best_generation = champion.generation;
  return true;
}

void Run::write_down(const GenerationRow& row) {
  const Stopwatch watch(files_s_);
  settle();
  progress_.evaluations += row.evaluations;
  progress_.steps += row.steps;
  progress_.wall_s += row.wall_s;
  csv_->write(csv_line(row));
  progress_.csv_bytes = csv_->size();
  if (archive_)
    if (const auto growth = search_->take_archive_growth(); !growth.empty()) archive_->write(growth);
  auto checkpoint = std::make_unique<io::AtomicFile>(paths().checkpoint);
  checkpoint->write(checkpoint_bytes(config_, progress_, population_, *search_));
  // What the checkpoint counts on must be on the disk before it.
  settling_ = std::async(std::launch::async,
                         [csv = csv_.get(), archive = archive_.get(), file = std::move(checkpoint)] {
                           csv->sync();
                           if (archive) archive->sync();
                           file->commit();
                         });
}

void Run::settle() {
  if (settling_.valid()) settling_.get();
}

}  // namespace amble::experiment
