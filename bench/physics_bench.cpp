#include <cmath>

#include "amble/experiment/problem.hpp"
#include "bench/benches.hpp"
#include "bench/workload.hpp"

namespace amble::bench {
namespace {

constexpr int steps = 300;

/// All joints swing through their range, legs a quarter apart: the same targets for every engine.
void set_targets(const morphology::RobotSpec& robot, int step, LaneArray& targets_rad) {
  for (int joint = 0; joint < targets_rad.rows(); ++joint) {
    const auto& spec = robot.joints[static_cast<std::size_t>(joint)];
    const double phase = 2.0 * 3.14159265358979 * (0.01 * step + 0.25 * (joint / 3));
    const double target =
        0.5 * (spec.lower_rad + spec.upper_rad) + 0.3 * (spec.upper_rad - spec.lower_rad) * std::sin(phase);
    for (int lane = 0; lane < targets_rad.lanes(); ++lane)
      targets_rad.at(joint, lane) = static_cast<float>(target);
  }
}

}  // namespace

void measure_physics(std::vector<Figure>& figures) {
  const auto config = authors_config();
  const auto robot = experiment::load_robot_file(config.robot);
  const auto engine = physics::make_engine("ode", robot, {.timestep_s = config.trial.timestep_s});
  LaneArray targets_rad(static_cast<int>(robot.joints.size()), engine->lanes());
  const double seconds = seconds_per_call([&] {
    for (int lane = 0; lane < engine->lanes(); ++lane) engine->place(lane);
    for (int step = 0; step < steps; ++step) {
      set_targets(robot, step, targets_rad);
      engine->step(targets_rad);
    }
  });
  figures.push_back(
      {"raw_steps_per_s_ode", steps * engine->lanes() / seconds, "1/s", "one core, authors' quadruped"});
}

}  // namespace amble::bench
