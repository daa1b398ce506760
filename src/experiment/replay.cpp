#include "amble/experiment/replay.hpp"

#include "amble/robot/json.hpp"
#include "amble/trial/observers.hpp"

namespace amble::experiment {

std::optional<Replay> replay(const Problem& original, const neat::Genome& genome,
                             const ReplayOptions& options, const std::atomic<bool>& stop) {
  Problem problem = original;
  if (options.seconds) problem.trial.duration_s = *options.seconds;
  if (options.engine) problem.engine = *options.engine;
  problem.trial.validate();

  const auto engine = problem.make_engine(options.record || options.observer);
  const auto controllers = problem.architecture->make_batch(engine->lanes());
  auto parameters = problem.decode(genome);

  trial::TraceObserver trace;
  trial::TriggerObserver triggers(*controllers);
  std::optional<trial::RecordingObserver> recording;
  trial::ObserverList observers;
  if (options.trace) observers.add(trace);
  observers.add(triggers);
  if (options.observer) observers.add(*options.observer);
  if (options.record) {
    recording.emplace(*options.record, problem.robot, *engine, *controllers, problem.trial.timestep_s,
                      robot::to_json(problem.robot).dump(),
                      problem.architecture->parameters_json(*parameters), options.origin);
    observers.add(*recording);
  }

  std::optional<trial::Scenario> scenario;
  if (options.noise) scenario = problem.scenario(*options.noise);
  trial::OneTask task(std::move(parameters), &observers, scenario ? &*scenario : nullptr);
  trial::Runner runner(*engine, *controllers, problem.protocol({}));
  runner.run(task, stop);
  if (!task.result()) return std::nullopt;
  if (recording) recording->finish(task.result()->outcome);
  return Replay{.result = summarise(problem, *task.result()),
                .legs = triggers.legs(),
                .triggers = triggers.counts(),
                .trace = trace.trace(),
                .physics_s = runner.physics_s()};
}

}  // namespace amble::experiment
