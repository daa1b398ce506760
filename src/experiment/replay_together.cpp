#include "amble/experiment/replay_together.hpp"

#include <algorithm>
#include <utility>

#include "amble/experiment/replay.hpp"
#include "amble/ground/height_field.hpp"

namespace amble::experiment {
namespace {

/// Trials of one controller, each with a scenario of its own or none.
class TogetherQueue : public trial::TaskQueue {
 public:
  TogetherQueue(std::shared_ptr<const controllers::Parameters> parameters,
                std::span<const TogetherTrial> trials,
                std::span<const std::optional<trial::Scenario>> scenarios)
      : parameters_(std::move(parameters)),
        trials_(trials),
        scenarios_(scenarios),
        trajectories_(trials.size()) {}

  std::optional<trial::Task> next() override {
    if (next_ == trials_.size()) return std::nullopt;
    const std::size_t i = next_++;
    return trial::Task{i, parameters_, trials_[i].observer, scenarios_[i] ? &*scenarios_[i] : nullptr};
  }
  void done(std::size_t index, record::Trajectory trajectory) override {
    trajectories_[index] = std::move(trajectory);
  }
  /// By trial; nothing of one that has not ended.
  const std::vector<std::optional<record::Trajectory>>& trajectories() const { return trajectories_; }

 private:
  std::shared_ptr<const controllers::Parameters> parameters_;
  std::span<const TogetherTrial> trials_;
  std::span<const std::optional<trial::Scenario>> scenarios_;
  std::size_t next_ = 0;
  std::vector<std::optional<record::Trajectory>> trajectories_;
};

/// The same for trials on the same ground.
ground::Key ground_key(const Problem& problem, const TogetherTrial& trial) {
  const ground::Key key = trial.noise ? ground_of(*trial.noise) : problem.ground_key;
  return ground::normalised(problem.ground, key);
}

/// Trials that are all on one ground. Appends their results; false if `stop` was set before the last ended.
bool replay_on(const Problem& problem, const std::shared_ptr<const ground::Ground>& ground,
               const std::shared_ptr<const controllers::Parameters>& parameters,
               std::span<const TogetherTrial> trials, std::vector<TrialResult>& results,
               const record::Measures& measures, const std::atomic<bool>& stop) {
  // Motor torques as in a replay() that is observed.
  const auto engine = problem.make_engine(true);
  if (ground) engine->set_ground(ground);
  const auto controllers = problem.architecture->make_batch(engine->lanes());
  std::vector<std::optional<trial::Scenario>> scenarios(trials.size());
  for (std::size_t i = 0; i < trials.size(); ++i)
    if (trials[i].noise) scenarios[i] = problem.scenario(*trials[i].noise, ground.get());
  TogetherQueue queue(parameters, trials, scenarios);
  record::Measures all = tracking_measures(problem);
  all |= measures;
  trial::Runner(*engine, *controllers, problem.protocol({}, all)).run(queue, stop);
  for (const auto& trajectory : queue.trajectories()) {
    if (!trajectory) return false;
    results.push_back(summarise(problem, *trajectory));
  }
  return true;
}

}  // namespace

std::optional<std::vector<TrialResult>> replay_together(const Problem& original, const neat::Genome& genome,
                                                        double seconds, std::span<const TogetherTrial> trials,
                                                        const std::atomic<bool>& stop,
                                                        const record::Measures& measures) {
  Problem problem = original;
  problem.trial.duration_s = seconds;
  problem.trial.validate();
  const std::shared_ptr<const controllers::Parameters> parameters = problem.decode(genome);
  std::vector<TrialResult> results;
  while (results.size() < trials.size()) {
    auto rest = trials.subspan(results.size());
    const ground::Key key = ground_key(problem, rest.front());
    const auto ground = problem.make_ground(key);
    // On the plane no trial has a ground of its own.
    if (ground) {
      const auto other = std::ranges::find_if(
          rest, [&](const TogetherTrial& trial) { return ground_key(problem, trial) != key; });
      rest = rest.first(static_cast<std::size_t>(other - rest.begin()));
    }
    if (!replay_on(problem, ground, parameters, rest, results, measures, stop)) return std::nullopt;
  }
  return results;
}

}  // namespace amble::experiment
