#include "amble/experiment/evaluator.hpp"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"

namespace amble::experiment {
namespace {

/// Hands out genomes by rising index and decodes each on the thread that asks for it.
class GenomeQueue : public trial::TaskQueue {
 public:
  GenomeQueue(const Problem& problem, std::span<const neat::Genome> genomes)
      : problem_(problem), genomes_(genomes), trajectories_(genomes.size()) {}

  std::optional<trial::Task> next() override {
    const std::size_t index = next_.fetch_add(1, std::memory_order_relaxed);
    if (index >= genomes_.size()) return std::nullopt;
    return trial::Task{index, problem_.decode(genomes_[index]), nullptr};
  }
  void done(std::size_t index, record::Trajectory trajectory) override {
    trajectories_[index] = std::move(trajectory);
    done_.fetch_add(1, std::memory_order_relaxed);
  }
  bool complete() const { return done_.load() == genomes_.size(); }
  std::vector<record::Trajectory> take() { return std::move(trajectories_); }

 private:
  const Problem& problem_;
  std::span<const neat::Genome> genomes_;
  std::vector<record::Trajectory> trajectories_;
  std::atomic<std::size_t> next_{0};
  std::atomic<std::size_t> done_{0};
};

/// What a worker works with; made by itself, in its first round.
struct Workplace {
  std::unique_ptr<physics::Engine> engine;
  std::unique_ptr<controllers::Batch> controllers;
};

}  // namespace

/// What the workers and their employer share. A round is one call of evaluate().
struct Evaluator::Shared {
  Shared(const Problem& problem_in, int path_stride_in) : problem(problem_in), path_stride(path_stride_in) {}
  ~Shared();

  void work();
  void one_round(Workplace& workplace);

  const Problem& problem;
  const int path_stride;
  std::mutex mutex;
  std::condition_variable wake, finished;
  int round = 0;
  int working = 0;
  bool quit = false;
  GenomeQueue* queue = nullptr;
  const std::atomic<bool>* stop = nullptr;
  std::uint64_t steps = 0;
  double physics_s = 0.0;
  std::exception_ptr failure;
  std::vector<std::jthread> workers;
};

void Evaluator::Shared::work() {
  Workplace workplace;
  for (int seen = 0;;) {
    {
      std::unique_lock lock(mutex);
      wake.wait(lock, [&] { return quit || round != seen; });
      if (quit) return;
      seen = round;
    }
    one_round(workplace);
  }
}

void Evaluator::Shared::one_round(Workplace& workplace) {
  std::exception_ptr caught;
  std::uint64_t own_steps = 0;
  double own_physics_s = 0.0;
  try {
    if (!workplace.engine) workplace.engine = problem.make_engine();
    if (!workplace.controllers)
      workplace.controllers = problem.architecture->make_batch(workplace.engine->lanes());
    trial::Runner runner(*workplace.engine, *workplace.controllers, problem.protocol(path_stride));
    runner.run(*queue, *stop);
    own_steps = runner.steps_simulated();
    own_physics_s = runner.physics_s();
  } catch (...) {
    caught = std::current_exception();
  }
  const std::lock_guard lock(mutex);
  if (caught && !failure) failure = caught;
  steps += own_steps;
  physics_s += own_physics_s;
  if (--working == 0) finished.notify_one();
}

Evaluator::Evaluator(const Problem& problem, int path_stride, int jobs)
    : shared_(std::make_unique<Shared>(problem, path_stride)) {
  AMBLE_CHECK(jobs >= 1, "an evaluator needs a worker");
  try {
    for (int i = 0; i < jobs; ++i)
      shared_->workers.emplace_back([shared = shared_.get()] { shared->work(); });
  } catch (const std::system_error& error) {
    fail(ExitCode::io, "cannot start {} workers: {}", jobs, error.code().message());
  }
}

Evaluator::~Evaluator() = default;

/// The workers, declared last, are waited for after this.
Evaluator::Shared::~Shared() {
  {
    const std::lock_guard lock(mutex);
    quit = true;
  }
  wake.notify_all();
}

std::optional<GenerationResult> Evaluator::evaluate(std::span<const neat::Genome> genomes,
                                                    const std::atomic<bool>& stop) {
  Shared& shared = *shared_;
  GenomeQueue queue(shared.problem, genomes);
  std::unique_lock lock(shared.mutex);
  shared.queue = &queue;
  shared.stop = &stop;
  shared.steps = 0;
  shared.physics_s = 0.0;
  shared.working = static_cast<int>(shared.workers.size());
  ++shared.round;
  shared.wake.notify_all();
  shared.finished.wait(lock, [&] { return shared.working == 0; });

  if (shared.failure) std::rethrow_exception(std::exchange(shared.failure, nullptr));
  if (!queue.complete()) return std::nullopt;
  return GenerationResult{queue.take(), shared.steps,
                          shared.physics_s / static_cast<double>(shared.workers.size())};
}

}  // namespace amble::experiment
