#include "amble/experiment/run.hpp"

#include <algorithm>
#include <future>
#include <new>
#include <optional>
#include <utility>

#include "amble/core/clock.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/champion.hpp"
#include "amble/experiment/champion_choice.hpp"
#include "amble/experiment/config.hpp"
#include "amble/experiment/episodes.hpp"
#include "amble/experiment/evaluator.hpp"
#include "amble/experiment/generation.hpp"
#include "amble/experiment/memory_need.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/experiment/run_files.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/experiment/typical.hpp"

namespace amble::experiment {
namespace {

/// Throws UserError if the run or one of its referees is impossible.
std::unique_ptr<const Problem> checked_problem(const Config& config, const robot::RobotSpec& robot) {
  auto problem = std::make_unique<const Problem>(Problem::make(config, robot));
  check_search(config, *problem);
  Problem elsewhere = *problem;
  for (const auto& referee : config.referees) {
    elsewhere.engine = referee;
    try {
      elsewhere.make_engine();
    } catch (const UserError& error) {
      fail(error.code(), "referees: {}", error.what());
    }
  }
  return problem;
}

RunState first_state(const Config& config, const Problem& problem) {
  try {
    return {config, problem};
  } catch (const std::bad_alloc&) {
    throw out_of_memory(config, problem);
  }
}

}  // namespace

class Run::State {
 public:
  State(RunFolder folder, const Config& config, std::unique_ptr<const Problem> problem, RunState state,
        RunFiles files, int jobs);

  RunStatus execute(RunListener& listener, const std::atomic<bool>& stop);

  const Config& config() const { return config_; }
  const Progress& progress() const { return state_.progress; }
  const RunPaths& paths() const { return folder_.paths(); }
  const Problem& problem() const { return *problem_; }
  const TrialTally& tally() const { return tally_; }
  int generation() const { return done_; }

 private:
  RunStatus generations(RunListener& listener, const std::atomic<bool>& stop);
  /// The best of a generation, of which the search forgets its candidates.
  struct Best {
    int index = 0;  ///< among the candidates
    neat::Genome genome;
  };
  /// What is known of a generation before its best is tried further.
  GenerationRow summarise(const EvaluatedGeneration& evaluated);
  Best best_of(const EvaluatedGeneration& evaluated, GenerationRow& row) const;
  /// Saves the best of a generation if it becomes the champion; false if `stop` was set meanwhile.
  bool keep_best(const Best& best, ChampionChoice& choice, TypicalTrials& typical, GenerationRow& row,
                 const std::atomic<bool>& stop);
  /// Measures what the champion typically does; false if `stop` was set meanwhile.
  bool measure_typical(TypicalTrials& trials, const neat::Genome& champion, const std::atomic<bool>& stop);
  void tell(const EvaluatedGeneration& evaluated, GenerationRow& row);

  RunFolder folder_;
  Config config_;
  std::unique_ptr<const Problem> problem_;
  std::unique_ptr<const score::Behaviour> behaviour_;
  RunState state_;
  RunFiles files_;
  GenerationMemory memory_;
  TrialTally tally_;
  int done_;  ///< generations that are written; the search may be told one more
  int jobs_;
};

Run::State::State(RunFolder folder, const Config& config, std::unique_ptr<const Problem> problem,
                  RunState state, RunFiles files, int jobs)
    : folder_(std::move(folder)),
      config_(config),
      problem_(std::move(problem)),
      behaviour_(config.make_behaviour(&problem_->robot)),
      state_(std::move(state)),
      files_(std::move(files)),
      done_(state_.strategy->round()),
      jobs_(jobs) {}

Run::Run(std::unique_ptr<State> state) : state_(std::move(state)) {}
Run::Run(Run&&) noexcept = default;
Run& Run::operator=(Run&&) noexcept = default;
Run::~Run() = default;

const Config& Run::config() const {
  return state_->config();
}
const Progress& Run::progress() const {
  return state_->progress();
}
const RunPaths& Run::paths() const {
  return state_->paths();
}
const robot::RobotSpec& Run::robot() const {
  return state_->problem().robot;
}
const Problem& Run::problem() const {
  return state_->problem();
}
const TrialTally& Run::tally() const {
  return state_->tally();
}
int Run::generation() const {
  return state_->generation();
}

Run Run::start(const std::filesystem::path& folder, const Config& config, int jobs) {
  return start(folder, config, load_robot(config), jobs);
}

Run Run::start(const std::filesystem::path& folder, const Config& config, const robot::RobotSpec& robot,
               int jobs) {
  auto problem = checked_problem(config, robot);  // before anything is written
  RunState state = first_state(config, *problem);
  auto held = RunFolder::create(folder, robot);
  auto files = RunFiles::start(held.paths(), config, state);
  held.note_process(config, jobs, 0);
  held.save_config(config);  // last: what has a config is a run
  return Run(std::make_unique<State>(std::move(held), config, std::move(problem), std::move(state),
                                     std::move(files), jobs));
}

Run Run::resume(const std::filesystem::path& folder, std::optional<int> generations, int jobs) {
  auto held = RunFolder::open(folder);
  Config config = held.load_config();
  if (generations) config.generations = *generations;
  auto problem = std::make_unique<const Problem>(Problem::make(config, held.load_robot()));
  check_search(config, *problem);
  auto [state, log_bytes] = recover(held.paths(), config, *problem);
  const int done = state.strategy->round();
  if (generations && *generations < done)
    fail(ExitCode::bad_input, "{}: {} generations are done already, --generations {} asks for fewer",
         folder.string(), done, *generations);
  auto files = RunFiles::resume(held.paths(), state, log_bytes);
  held.remove_leftovers();
  if (done < config.generations) held.note_process(config, jobs, done);
  if (generations) held.lengthen(config);
  return Run(std::make_unique<State>(std::move(held), config, std::move(problem), std::move(state),
                                     std::move(files), jobs));
}

RunStatus Run::execute(RunListener& listener, const std::atomic<bool>& stop) {
  return state_->execute(listener, stop);
}

RunStatus Run::State::execute(RunListener& listener, const std::atomic<bool>& stop) {
  try {
    const RunStatus status = generations(listener, stop);
    files_.settle();
    return status;
  } catch (const std::bad_alloc&) {
    throw out_of_memory(config_, *problem_);
  }
}

// The generation loop: evaluate, tell, keep the best, write. With several workers the next generation is
// already evaluated while the best of this one is tried further, which is work for one of them.
RunStatus Run::State::generations(RunListener& listener, const std::atomic<bool>& stop) {
  Evaluator evaluator(*problem_, behaviour_->path(), jobs_, behaviour_->measures());
  ChampionChoice choice(config_, *problem_, folder_.paths());
  TypicalTrials typical(*problem_, config_.seed, running_trials);
  if (const int best = progress().best_generation; best >= 0) {
    const auto champion = load_champion(paths().champion(best));
    if (!measure_typical(typical, champion.genome, stop)) return RunStatus::interrupted;
  }
  std::future<std::optional<EvaluatedGeneration>> evaluating;
  const auto evaluate_next = [&] {
    const int generation = state_.strategy->round();
    if (generation >= config_.generations) return;
    // The search itself is asked here: it need not be thread-safe.
    const auto candidates = state_.strategy->ask();
    evaluating =
        std::async(jobs_ > 1 ? std::launch::async : std::launch::deferred, [&, generation, candidates] {
          return evaluate_generation(evaluator, *problem_, config_.evaluation, memory_, config_.seed,
                                     generation, candidates, stop);
        });
  };
  double last_row_s = now_s(), files_s = 0.0;
  for (evaluate_next(); evaluating.valid();) {
    auto evaluated = evaluating.get();
    if (!evaluated || stop)
      return RunStatus::interrupted;  // also if it ended just before the listener stopped
    GenerationRow row = summarise(*evaluated);
    const Best best = best_of(*evaluated, row);
    tell(*evaluated, row);
    evaluated.reset();  // before the next generation needs as much memory
    evaluate_next();
    if (!keep_best(best, choice, typical, row, stop)) return RunStatus::interrupted;

    const double row_s = now_s();
    row.wall_s = row_s - std::exchange(last_row_s, row_s);
    row.times.files_s += std::exchange(files_s, 0.0);
    {
      const Stopwatch watch(files_s);
      files_.write(row, config_, state_);
    }
    ++done_;
    listener.on_generation(row, progress(), config_);
  }
  return RunStatus::finished;
}

GenerationRow Run::State::summarise(const EvaluatedGeneration& evaluated) {
  const GenerationResult& result = evaluated.result;
  const std::vector<double>& objectives = evaluated.objectives;
  GenerationRow row;
  row.generation = state_.strategy->round();
  row.times = result.times;
  row.evaluations = objectives.size();
  row.steps = result.steps;
  summarise_trials(objectives, result.trajectories, row);
  tally_.add(result.trajectories, problem_->trial.steps());
  return row;
}

Run::State::Best Run::State::best_of(const EvaluatedGeneration& evaluated, GenerationRow& row) const {
  const auto best = evaluated.best();
  const neat::Genome& genome = state_.strategy->ask()[best];
  row.best_hidden = genome.count(neat::NodeKind::hidden);
  row.best_links = genome.enabled_links();
  return {static_cast<int>(best), genome};
}

bool Run::State::keep_best(const Best& best, ChampionChoice& choice, TypicalTrials& typical,
                           GenerationRow& row, const std::atomic<bool>& stop) {
  Progress& progress = state_.progress;
  const auto preferred = choice.prefers(best.genome, row.best, progress, stop);
  if (!preferred) return false;
  if (*preferred) {
    const NewBest found{
        .generation = row.generation, .index = best.index, .genome = best.genome, .objective = row.best};
    const auto champion = try_champion(config_, *problem_, found, jobs_, row.times, stop);
    if (!champion || !measure_typical(typical, best.genome, stop)) return false;
    const Stopwatch watch(row.times.files_s);
    folder_.save_champion(*champion);
    progress.best = row.best;
    progress.best_generation = row.generation;
  }
  row.best_so_far = progress.best;
  row.typical = progress.typical.value_or(score::Typical());
  return true;
}

bool Run::State::measure_typical(TypicalTrials& trials, const neat::Genome& champion,
                                 const std::atomic<bool>& stop) {
  const auto results = trials.run(champion, stop);
  if (results) state_.progress.typical = typical_objective(*problem_, *results);
  return results.has_value();
}

void Run::State::tell(const EvaluatedGeneration& evaluated, GenerationRow& row) {
  const Stopwatch watch(row.times.search_s);
  const ToldGeneration generation = told(evaluated, *behaviour_);
  state_.strategy->tell(generation.evaluations);
  row.search = state_.strategy->metrics();
}

}  // namespace amble::experiment
