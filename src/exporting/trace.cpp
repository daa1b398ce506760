#include "amble/exporting/trace.hpp"

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/trial/trial.hpp"

namespace amble::exporting {
namespace {

std::vector<float> of_lane(const LaneArray& rows, int lane) {
  std::vector<float> values;
  values.reserve(to_index(rows.rows()));
  for (int row = 0; row < rows.rows(); ++row) values.push_back(rows.at(row, lane));
  return values;
}

Trace::Tick sensed(const physics::Engine& engine, int lane) {
  const robot::SensorFrame& sensors = engine.sensors();
  return {.angle_rad = of_lane(sensors.joint_angle_rad, lane),
          .touch = of_lane(sensors.touch, lane),
          .attitude_rad = of_lane(sensors.attitude_rad, lane),
          .target_rad = {},
          .state = {}};
}

/// Pairs what an engine senses after a step with what the controller answers in the next one.
class Recorder final : public trial::Observer {
 public:
  Recorder(Trace& trace, Trace::Tick first, bool skip_first)
      : trace_(trace), sensed_(std::move(first)), skip_(skip_first) {}

  void on_step(int, const physics::Engine& engine, const controllers::Batch& controllers,
               const LaneArray& targets_rad, int lane) override {
    // trial::FirstCommand::after_first_step: the motors held the joints in this step.
    if (!std::exchange(skip_, false)) {
      sensed_.target_rad = of_lane(targets_rad, lane);
      sensed_.state.resize(trace_.state_names.size());
      controllers.state(lane, sensed_.state);
      trace_.ticks.push_back(std::move(sensed_));
    }
    sensed_ = sensed(engine, lane);
  }

 private:
  Trace& trace_;
  Trace::Tick sensed_;
  bool skip_;
};

}  // namespace

Trace record_trace(const experiment::Problem& original, const neat::Genome& genome, int ticks,
                   const std::atomic<bool>& stop) {
  experiment::Problem problem = original;
  problem.damage = {};  // test vectors are of what controllers read, and numb feet would not show in them
  const bool skip_first = problem.trial.first_command == trial::FirstCommand::after_first_step;
  problem.trial.duration_s = (ticks + (skip_first ? 1 : 0)) * problem.trial.timestep_s;
  problem.trial.validate();
  const auto engine = problem.make_engine();
  const auto controllers = problem.architecture->make_batch(engine->lanes());
  Trace trace{.state_names = controllers->state_names(), .ticks = {}};
  engine->place(0);
  Recorder recorder(trace, sensed(*engine, 0), skip_first);
  trial::OneTask task(problem.decode(genome), &recorder);
  trial::Runner runner(*engine, *controllers, problem.protocol({}));
  runner.run(task, stop);
  if (!task.result()) fail(ExitCode::interrupted, "stopped before the end of the trial");
  return trace;
}

}  // namespace amble::exporting
