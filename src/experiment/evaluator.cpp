#include "amble/experiment/evaluator.hpp"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "amble/core/check.hpp"

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

}  // namespace

/// What the workers and their employer share. A round is one call of evaluate().
struct Evaluator::Shared {
  Shared(const Problem& problem_in, int path_stride_in) : problem(problem_in), path_stride(path_stride_in) {}

  void work();
  void one_round(trial::Runner& runner);

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
  const auto engine = problem.make_engine();
  const auto controllers = problem.architecture->make_batch(engine->lanes());
  for (int seen = 0;;) {
    {
      std::unique_lock lock(mutex);
      wake.wait(lock, [&] { return quit || round != seen; });
      if (quit) return;
      seen = round;
    }
    trial::Runner runner(*engine, *controllers, problem.protocol(path_stride));
    one_round(runner);
  }
}

void Evaluator::Shared::one_round(trial::Runner& runner) {
  std::exception_ptr caught;
  try {
    runner.run(*queue, *stop);
  } catch (...) {
    caught = std::current_exception();
  }
  const std::lock_guard lock(mutex);
  if (caught && !failure) failure = caught;
  steps += runner.steps_simulated();
  physics_s += runner.physics_s();
  if (--working == 0) finished.notify_one();
}

Evaluator::Evaluator(const Problem& problem, int path_stride, int jobs)
    : shared_(std::make_unique<Shared>(problem, path_stride)) {
  AMBLE_CHECK(jobs >= 1, "an evaluator needs a worker");
  for (int i = 0; i < jobs; ++i) shared_->workers.emplace_back([shared = shared_.get()] { shared->work(); });
}

Evaluator::~Evaluator() {
  {
    const std::lock_guard lock(shared_->mutex);
    shared_->quit = true;
  }
  shared_->wake.notify_all();
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
