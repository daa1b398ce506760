#include "amble/experiment/replay.hpp"

#include "amble/damage/stages.hpp"
#include "amble/experiment/plan/told_generation.hpp"
#include "amble/ground/recorded.hpp"
#include "amble/io/json_file.hpp"
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
  const ground::Key ground_key = options.noise ? ground_of(*options.noise) : problem.ground_key;
  const auto ground = problem.make_ground(ground_key);
  if (ground) engine->set_ground(ground);
  const auto controllers = problem.architecture->make_batch(engine->lanes());
  auto parameters = problem.decode(genome);

  std::optional<trial::Scenario> scenario;
  if (options.noise) scenario = problem.scenario(*options.noise, ground.get());
  const trial::Protocol protocol = problem.protocol({}, tracking_measures(problem));
  const trial::CommandSchedule* const commands = scenario && scenario->commands ? &*scenario->commands
                                                 : protocol.commands            ? &*protocol.commands
                                                                                : nullptr;

  trial::TraceObserver trace;
  trial::EventObserver events(*controllers);
  std::optional<trial::RecordingObserver> recording;
  trial::ObserverList observers;
  if (options.trace) observers.add(trace);
  observers.add(events);
  if (options.observer) observers.add(*options.observer);
  if (options.record) {
    recording.emplace(
        *options.record,
        record::RecordingHeader{
            .frame_s = problem.trial.timestep_s,
            .columns = {},
            .robot_json = robot::to_json(damage::as_drawn(problem.robot, problem.damage)).dump(),
            .controller_json = problem.architecture->parameters_json(*parameters),
            .origin = options.origin,
            .ground_json = ground ? ground::to_json(problem.ground, ground_key).dump() : std::string(),
            .damage_json =
                problem.damage.is_default() ? std::string() : io::settings_to_json(problem.damage).dump(),
            .mass_kg = problem.damage.changes_body() ? std::optional(problem.mass_kg()) : std::nullopt},
        problem.robot, *engine, *controllers, commands);
    observers.add(*recording);
  }

  trial::OneTask task(std::move(parameters), &observers, scenario ? &*scenario : nullptr);
  trial::Runner runner(*engine, *controllers, protocol);
  runner.run(task, stop);
  if (!task.result()) return std::nullopt;
  if (recording) recording->finish(task.result()->outcome);
  return Replay{.result = summarise(problem, *task.result()),
                .events = events.counts(),
                .trace = trace.trace(),
                .physics_s = runner.physics_s()};
}

}  // namespace amble::experiment
