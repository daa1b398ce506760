#include "amble/browser/trials.hpp"

#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/plan/told_generation.hpp"
#include "amble/io/binary.hpp"
#include "amble/neat/genome_io.hpp"
#include "amble/trial/observers.hpp"

namespace amble::browser {

std::string ToldGenomes::bytes() const {
  io::BinaryWriter writer;
  writer.put(steps);
  writer.put(static_cast<std::uint64_t>(genomes.size()));
  for (const Told& told : genomes) {
    writer.put(told.objective);
    writer.put(told.viable);
    writer.put(told.fell);
    writer.put(told.diverged);
    writer.put(told.end_x_m);
    writer.put(told.end_y_m);
    writer.put_span(std::span<const float>(told.behaviour));
  }
  return writer.bytes();
}

ToldGenomes ToldGenomes::read(std::string_view bytes) {
  io::BinaryReader reader(bytes, "evaluations");
  ToldGenomes all;
  all.steps = reader.get<std::uint64_t>();
  constexpr std::size_t least_bytes = sizeof(double) + 1 + 2 * sizeof(std::int32_t) + 2 * sizeof(float);
  all.genomes.resize(reader.get_count(least_bytes));
  for (Told& told : all.genomes) {
    told.objective = reader.get<double>();
    told.viable = reader.get<bool>();
    told.fell = reader.get<std::int32_t>();
    told.diverged = reader.get<std::int32_t>();
    told.end_x_m = reader.get<float>();
    told.end_y_m = reader.get<float>();
    told.behaviour = reader.get_vector<float>();
  }
  reader.finish();
  return all;
}

/// The episodes of some genomes, one after the other.
class Trials::Queue : public trial::TaskQueue {
 public:
  Queue(const experiment::Problem& problem, std::vector<neat::Genome> genomes,
        std::vector<trial::Scenario> scenarios)
      : problem_(problem), genomes_(std::move(genomes)), scenarios_(std::move(scenarios)) {
    trajectories.resize(genomes_.size() * episodes());
  }

  std::size_t episodes() const { return std::max<std::size_t>(1, scenarios_.size()); }
  std::optional<trial::Task> next() override {
    if (next_ == trajectories.size()) return std::nullopt;
    const std::size_t episode = next_ % episodes();
    if (episode == 0) parameters_ = problem_.decode(genomes_[next_ / episodes()]);
    return trial::Task{.index = next_++,
                       .parameters = parameters_,
                       .observer = nullptr,
                       .scenario = scenarios_.empty() ? nullptr : &scenarios_[episode]};
  }
  void done(std::size_t index, record::Trajectory trajectory) override {
    trajectories[index] = std::move(trajectory);
  }

  std::vector<record::Trajectory> trajectories;

 private:
  const experiment::Problem& problem_;
  std::vector<neat::Genome> genomes_;
  std::vector<trial::Scenario> scenarios_;
  std::shared_ptr<const controllers::Parameters> parameters_;
  std::size_t next_ = 0;
};

Trials::Trials(std::shared_ptr<const Plan> plan)
    : plan_(std::move(plan)),
      engine_(plan_->problem.make_engine(plan_->behaviour->measures().need_torques())),
      controllers_(plan_->problem.architecture->make_batch(engine_->lanes())) {
  const auto& behaviour = *plan_->behaviour;
  runner_ = std::make_unique<trial::Runner>(*engine_, *controllers_,
                                            plan_->problem.protocol(behaviour.path(), behaviour.measures()));
}

Trials::~Trials() = default;

void Trials::begin(int generation, std::string_view genomes) {
  io::BinaryReader reader(genomes, "genomes");
  auto read = neat::load_genomes(reader);
  reader.finish();
  const experiment::Problem& problem = plan_->problem;
  const auto& config = plan_->config;
  const int drawn = experiment::noise_generation(config.evaluation.draw, generation);
  const auto ground = ground_.of(problem, config.seed, drawn);
  if (engine_->ground() != ground.get()) engine_->set_ground(ground);
  auto queue =
      std::make_unique<Queue>(problem, std::move(read), problem.scenarios(config.seed, drawn, ground.get()));
  runner_->begin(*queue);
  queue_ = std::move(queue);
  steps_before_ = runner_->steps_simulated();
}

bool Trials::advance(int steps) {
  AMBLE_CHECK(queue_ != nullptr, "genomes come first");
  for (int i = 0; i < steps; ++i)
    if (!runner_->tick(*queue_)) return true;
  return false;
}

ToldGenomes Trials::told() const {
  AMBLE_CHECK(queue_ != nullptr, "genomes come first");
  const experiment::Problem& problem = plan_->problem;
  const std::size_t episodes = queue_->episodes();
  const std::span<const record::Trajectory> trials = queue_->trajectories;
  const auto objectives = experiment::objectives(problem, trials, episodes);
  const auto told = experiment::told(trials, episodes, objectives, *plan_->behaviour);
  ToldGenomes all{.steps = runner_->steps_simulated() - steps_before_, .genomes = {}};
  for (std::size_t i = 0; i < objectives.size(); ++i) {
    Told one{
        .objective = objectives[i], .viable = told.evaluations[i].viable, .behaviour = told.behaviours[i]};
    for (const auto& trial : trials.subspan(i * episodes, episodes)) {
      one.fell += trial.outcome == record::Outcome::fell;
      one.diverged += trial.outcome == record::Outcome::diverged;
    }
    const record::Trajectory& first = trials[i * episodes];
    one.end_x_m = static_cast<float>(first.com_end_m.x - first.com_start_m.x);
    one.end_y_m = static_cast<float>(first.com_end_m.y - first.com_start_m.y);
    all.genomes.push_back(std::move(one));
  }
  return all;
}

namespace {

/// Trials of one genome, the first of them observed.
class OneGenome : public trial::TaskQueue {
 public:
  OneGenome(std::shared_ptr<const controllers::Parameters> parameters,
            std::span<const trial::Scenario> scenarios, trial::Observer* observer)
      : trajectories(std::max<std::size_t>(1, scenarios.size())),
        parameters_(std::move(parameters)),
        scenarios_(scenarios),
        observer_(observer) {}
  std::optional<trial::Task> next() override {
    if (next_ == trajectories.size()) return std::nullopt;
    const std::size_t i = next_++;
    return trial::Task{.index = i,
                       .parameters = parameters_,
                       .observer = i == 0 ? observer_ : nullptr,
                       .scenario = scenarios_.empty() ? nullptr : &scenarios_[i]};
  }
  void done(std::size_t index, record::Trajectory trajectory) override {
    trajectories[index] = std::move(trajectory);
  }

  std::vector<record::Trajectory> trajectories;

 private:
  std::shared_ptr<const controllers::Parameters> parameters_;
  std::span<const trial::Scenario> scenarios_;
  trial::Observer* observer_;
  std::size_t next_ = 0;
};

}  // namespace

std::vector<record::Trajectory> trials_of(const experiment::Problem& problem, const neat::Genome& genome,
                                          std::span<const trial::Scenario> scenarios,
                                          const std::shared_ptr<const ground::Ground>& ground,
                                          std::vector<std::uint32_t>* trace) {
  const auto physics = problem.make_engine();
  if (ground) physics->set_ground(ground);
  const auto batch = problem.architecture->make_batch(physics->lanes());
  trial::Runner runner(*physics, *batch, problem.protocol({}, experiment::tracking_measures(problem)));
  trial::TraceObserver observer;
  OneGenome queue(problem.decode(genome), scenarios, trace ? &observer : nullptr);
  runner.begin(queue);
  while (runner.tick(queue)) {
  }
  if (trace) *trace = observer.trace();
  return std::move(queue.trajectories);
}

}  // namespace amble::browser
