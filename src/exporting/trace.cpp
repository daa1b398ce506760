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

Trace::Tick of_lane(const robot::SensorFrame& sensors, int lane) {
  return {.angle_rad = of_lane(sensors.joint_angle_rad, lane),
          .touch = of_lane(sensors.touch, lane),
          .attitude_rad = of_lane(sensors.attitude_rad, lane),
          .speed_rad_s = of_lane(sensors.joint_speed_rad_s, lane),
          .torque_nm = of_lane(sensors.joint_torque_nm, lane),
          .load_n = of_lane(sensors.foot_load_n, lane),
          .yaw_rate_rad_s = of_lane(sensors.yaw_rate_rad_s, lane),
          .command = of_lane(sensors.command, lane),
          .heading_error_rad = of_lane(sensors.heading_error_rad, lane),
          .target_rad = {},
          .state = {}};
}

/// Pairs what an engine senses after a step with what the controller answers in the next one.
class Recorder final : public trial::Observer {
 public:
  /// `engine`: with the robot in its start pose.
  Recorder(Trace& trace, const trial::Protocol& protocol, const physics::Engine& engine, bool skip_first)
      : trace_(trace), senses_(protocol.sensing, engine.sensors(), protocol.timestep_s), skip_(skip_first) {
    senses_.load(0, engine, nullptr, protocol.commands ? &*protocol.commands : nullptr);
    sensed_ = of_lane(senses_.read(engine), 0);
  }

  void on_step(int, const physics::Engine& engine, const controllers::Batch& controllers,
               const LaneArray& targets_rad, int lane) override {
    // trial::FirstCommand::after_first_step: the motors held the joints in this step.
    if (std::exchange(skip_, false)) {
      senses_.face(0, engine);
    } else {
      sensed_.target_rad = of_lane(targets_rad, lane);
      sensed_.state.resize(trace_.state_names.size());
      controllers.state(lane, sensed_.state);
      trace_.ticks.push_back(std::move(sensed_));
    }
    sensed_ = of_lane(senses_.read(engine), lane);
  }

 private:
  Trace& trace_;
  trial::Senses senses_;
  Trace::Tick sensed_;
  bool skip_;
};

}  // namespace

Trace record_trace(const experiment::Problem& original, const neat::Genome& genome, int ticks,
                   const std::atomic<bool>& stop) {
  experiment::Problem problem = original;
  // Test vectors are of what controllers read. Numb feet would not show in them, nor would what is between a
  // quantity and its reading, which is not exported.
  problem.damage = {};
  for (controllers::SensorSettings& sensor : problem.controller.sensing.sensors)
    sensor = {.of = sensor.of, .scale = sensor.scale};
  const bool skip_first = problem.trial.first_command == trial::FirstCommand::after_first_step;
  problem.trial.duration_s = (ticks + (skip_first ? 1 : 0)) * problem.trial.timestep_s;
  problem.trial.validate();
  const auto engine = problem.make_engine();
  const auto controllers = problem.architecture->make_batch(engine->lanes());
  Trace trace{.state_names = controllers->state_names(), .ticks = {}};
  engine->place(0);
  trial::Protocol protocol = problem.protocol({});
  // Who senses a heading error alone is told commands all the same, and its error follows from them.
  protocol.sensing.extra.command |= protocol.sensing.extra.heading_error;
  Recorder recorder(trace, protocol, *engine, skip_first);
  trial::OneTask task(problem.decode(genome), &recorder);
  trial::Runner runner(*engine, *controllers, protocol);
  runner.run(task, stop);
  if (!task.result()) fail(ExitCode::interrupted, "stopped before the end of the trial");
  return trace;
}

}  // namespace amble::exporting
