#include "amble/experiment/evaluator.hpp"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/clock.hpp"
#include "amble/core/error.hpp"

namespace amble::experiment {
namespace {

/// Part of the episodes of one genome.
struct Share {
  std::size_t genome = 0, first = 0, end = 0;
};

/// The generation being evaluated, shared by all workers: dispenses the episodes of genomes by rising index,
/// collects results. A genome's episodes go to one worker, which decodes it once, unless there are fewer
/// genomes than workers; then each worker's share fills its lanes.
class EvaluationRound {
 public:
  EvaluationRound(const Problem& problem_in, std::span<const neat::Genome> genomes_in,
                  std::span<const trial::Scenario> scenarios_in,
                  std::shared_ptr<const ground::Ground> ground_in, std::size_t workers)
      : problem(problem_in),
        genomes(genomes_in),
        scenarios(scenarios_in),
        ground(std::move(ground_in)),
        trajectories_(genomes.size() * episodes()) {
    if (genomes.size() >= workers) return;
    const auto lanes = to_index(physics::engine_traits(problem.engine).lanes);
    shares_ = std::max<std::size_t>(1, std::min(workers, episodes() / lanes));
  }

  std::size_t episodes() const { return std::max<std::size_t>(1, scenarios.size()); }
  /// Nothing when all are given out.
  std::optional<Share> next_share() {
    const std::size_t index = next_.fetch_add(1, std::memory_order_relaxed);
    if (index >= genomes.size() * shares_) return std::nullopt;
    const std::size_t part = index % shares_;
    return Share{.genome = index / shares_,
                 .first = episodes() * part / shares_,
                 .end = episodes() * (part + 1) / shares_};
  }
  void done(std::size_t index, record::Trajectory trajectory) {
    trajectories_[index] = std::move(trajectory);
    done_.fetch_add(1, std::memory_order_relaxed);
  }
  bool complete() const { return done_.load() == trajectories_.size(); }
  std::vector<record::Trajectory> take() { return std::move(trajectories_); }

  const Problem& problem;
  const std::span<const neat::Genome> genomes;
  const std::span<const trial::Scenario> scenarios;
  const std::shared_ptr<const ground::Ground> ground;

 private:
  std::vector<record::Trajectory> trajectories_;
  std::size_t shares_ = 1;  ///< of each genome's episodes
  std::atomic<std::size_t> next_{0};
  std::atomic<std::size_t> done_{0};
};

/// The tasks of one worker: takes a share, decodes its genome once, and gives out the episodes in order. A
/// task's index is that of its trajectory.
class WorkerQueue : public trial::TaskQueue {
 public:
  explicit WorkerQueue(EvaluationRound& round) : round_(round) {}

  std::optional<trial::Task> next() override {
    if (share_.first == share_.end && !take_share()) return std::nullopt;
    const std::size_t episode = share_.first++;
    const trial::Scenario* const scenario = round_.scenarios.empty() ? nullptr : &round_.scenarios[episode];
    const std::size_t index = share_.genome * round_.episodes() + episode;
    return trial::Task{index, parameters_, nullptr, scenario};
  }
  void done(std::size_t index, record::Trajectory trajectory) override {
    round_.done(index, std::move(trajectory));
  }
  double decode_s() const { return decode_s_; }

 private:
  bool take_share() {
    const auto share = round_.next_share();
    if (!share) return false;
    const Stopwatch watch(decode_s_);
    parameters_ = round_.problem.decode(round_.genomes[share->genome]);
    share_ = *share;
    return true;
  }

  EvaluationRound& round_;
  Share share_;  ///< what is left of it
  std::shared_ptr<const controllers::Parameters> parameters_;
  double decode_s_ = 0.0;
};

/// Engine, controllers and runner of one worker, created by its thread in the first round. They are kept for
/// all rounds: a lane that stays empty for a round still refers to its last parameters.
struct WorkerContext {
  std::unique_ptr<physics::Engine> engine;
  std::unique_ptr<controllers::Batch> controllers;
  std::optional<trial::Runner> runner;

  trial::Runner& open(const Problem& problem, const record::PathSampling& path,
                      const record::Measures& measures, const std::shared_ptr<const ground::Ground>& ground) {
    if (!engine) engine = problem.make_engine(measures.need_torques());
    if (engine->ground() != ground.get()) engine->set_ground(ground);
    if (!controllers) controllers = problem.architecture->make_batch(engine->lanes());
    if (!runner) runner.emplace(*engine, *controllers, problem.protocol(path, measures));
    return *runner;
  }
};

}  // namespace

/// State shared by evaluate() and the workers. A round is one call of evaluate().
struct Evaluator::Shared {
  Shared(const Problem& problem_in, const record::PathSampling& path_in, const record::Measures& measures_in)
      : problem(problem_in), path(path_in), measures(measures_in) {}
  ~Shared();

  void work();
  void one_round(WorkerContext& context);

  const Problem& problem;
  const record::PathSampling path;
  const record::Measures measures;
  std::mutex mutex;
  std::condition_variable wake, finished;
  int round = 0;
  int working = 0;
  bool quit = false;
  EvaluationRound* current = nullptr;
  const std::atomic<bool>* stop = nullptr;
  std::uint64_t steps = 0;
  StageTimes times;     ///< sums over the workers, without waiting
  double busy_s = 0.0;  ///< sum of the durations of their rounds
  std::exception_ptr failure;
  std::vector<std::jthread> workers;
};

void Evaluator::Shared::work() {
  WorkerContext context;
  for (int seen = 0;;) {
    {
      std::unique_lock lock(mutex);
      wake.wait(lock, [&] { return quit || round != seen; });
      if (quit) return;
      seen = round;
    }
    one_round(context);
  }
}

void Evaluator::Shared::one_round(WorkerContext& context) {
  std::exception_ptr caught;
  std::uint64_t own_steps = 0;
  StageTimes own;
  const double start_s = now_s();
  try {
    trial::Runner& runner = context.open(problem, path, measures, current->ground);
    const std::uint64_t steps_before = runner.steps_simulated();
    const double physics_before_s = runner.physics_s(), control_before_s = runner.control_s();
    WorkerQueue queue(*current);
    runner.run(queue, *stop);
    own_steps = runner.steps_simulated() - steps_before;
    own = {.physics_s = runner.physics_s() - physics_before_s,
           .decode_s = queue.decode_s(),
           .control_s = runner.control_s() - control_before_s};
  } catch (...) {
    caught = std::current_exception();
  }
  const std::lock_guard lock(mutex);
  if (caught && !failure) failure = caught;
  steps += own_steps;
  for (const Stage& stage : stages) times.*stage.seconds += own.*stage.seconds;
  busy_s += now_s() - start_s;
  if (--working == 0) finished.notify_one();
}

Evaluator::Evaluator(const Problem& problem, const record::PathSampling& path, int jobs,
                     const record::Measures& measures)
    : shared_(std::make_unique<Shared>(problem, path, measures)) {
  AMBLE_CHECK(jobs >= 1, "an evaluator needs a worker");
  try {
    for (int i = 0; i < jobs; ++i)
      shared_->workers.emplace_back([shared = shared_.get()] { shared->work(); });
  } catch (const std::system_error& error) {
    fail(ExitCode::io, "cannot start {} workers: {}", jobs, error.code().message());
  }
}

Evaluator::~Evaluator() {
  // In a forked process its threads are not there to be joined.
  if (!works_here()) static_cast<void>(shared_.release());
}

/// Signals the workers to quit; the jthreads, declared last, are joined after this.
Evaluator::Shared::~Shared() {
  {
    const std::lock_guard lock(mutex);
    quit = true;
  }
  wake.notify_all();
}

std::optional<GenerationResult> Evaluator::evaluate(std::span<const neat::Genome> genomes,
                                                    const std::atomic<bool>& stop,
                                                    std::span<const trial::Scenario> scenarios,
                                                    std::shared_ptr<const ground::Ground> ground) {
  if (!works_here())
    fail(ExitCode::internal, "workers do not come along into a forked process: make an Evaluator there");
  Shared& shared = *shared_;
  EvaluationRound evaluation(shared.problem, genomes, scenarios, std::move(ground), shared.workers.size());
  std::unique_lock lock(shared.mutex);
  shared.current = &evaluation;
  shared.stop = &stop;
  shared.steps = 0;
  shared.times = {};
  shared.busy_s = 0.0;
  shared.working = static_cast<int>(shared.workers.size());
  ++shared.round;
  const double start_s = now_s();
  shared.wake.notify_all();
  shared.finished.wait(lock, [&] { return shared.working == 0; });

  if (shared.failure) std::rethrow_exception(std::exchange(shared.failure, nullptr));
  if (!evaluation.complete()) return std::nullopt;
  const auto workers = static_cast<double>(shared.workers.size());
  StageTimes times = shared.times;
  for (const Stage& stage : stages) times.*stage.seconds /= workers;
  times.waiting_s = now_s() - start_s - shared.busy_s / workers;
  return GenerationResult{.trajectories = evaluation.take(),
                          .episodes = evaluation.episodes(),
                          .steps = shared.steps,
                          .times = times};
}

}  // namespace amble::experiment
