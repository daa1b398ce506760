#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "amble/core/random.hpp"
#include "amble/experiment/problem.hpp"
#include "bench/benches.hpp"
#include "bench/workload.hpp"

namespace amble::bench {
namespace {

constexpr int lanes = 16, ticks = 300;

/// Sensor values of sixteen robots that walk out of phase with each other.
robot::SensorFrame sensed(int tick, int joints, int legs) {
  robot::SensorFrame frame{LaneArray(joints, lanes), LaneArray(legs, lanes), LaneArray(3, lanes)};
  for (int lane = 0; lane < lanes; ++lane) {
    const auto wave = [&](int row) {
      return std::sin((0.05 + 0.004 * lane) * tick + 1.3 * row + 0.7 * lane);
    };
    for (int joint = 0; joint < joints; ++joint)
      frame.joint_angle_rad.at(joint, lane) = static_cast<float>(0.6 * wave(joint));
    for (int leg = 0; leg < legs; ++leg) frame.touch.at(leg, lane) = wave(leg) > 0.0 ? 1.0f : 0.0f;
    for (int axis = 0; axis < 3; ++axis)
      frame.attitude_rad.at(axis, lane) = static_cast<float>(0.3 * wave(axis));
  }
  frame.command = LaneArray(2, lanes);
  frame.heading_error_rad = frame.yaw_rate_rad_s = frame.command_stop = LaneArray(1, lanes);
  for (int lane = 0; lane < lanes; ++lane) {
    frame.command.at(0, lane) = 0.4f;
    frame.command.at(1, lane) = static_cast<float>(0.5 * std::sin(0.01 * tick + lane));
    frame.heading_error_rad.at(0, lane) = frame.yaw_rate_rad_s.at(0, lane) = frame.attitude_rad.at(2, lane);
  }
  return frame;
}

/// µs per tick and lane of sixteen different controllers.
double controller_us(const std::string& config_name, std::vector<std::string> assignments = {}) {
  const auto config =
      experiment::load_config(AMBLE_SOURCE_DIR "/configs/authors/" + config_name + "-objective.toml",
                              {.assignments = std::move(assignments), .seed = {}, .generations = {}});
  const auto robot = experiment::load_robot_file(config.robot);
  const auto problem = experiment::Problem::make(config, robot);
  const auto genomes = evolved_genomes(lanes, problem.cppn_inputs(), problem.cppn_outputs());
  const auto batch = problem.architecture->make_batch(lanes);
  std::vector<std::unique_ptr<controllers::Parameters>> parameters;
  for (int lane = 0; lane < lanes; ++lane) {
    parameters.push_back(problem.decode(genomes[static_cast<std::size_t>(lane)]));
    batch->load(lane, *parameters.back());
  }
  const auto joints = static_cast<int>(robot.joints.size()), legs = static_cast<int>(robot.legs.size());
  std::vector<robot::SensorFrame> frames;
  for (int tick = 0; tick < ticks; ++tick) frames.push_back(sensed(tick, joints, legs));
  LaneArray targets_rad(joints, lanes);
  const double seconds = seconds_per_call([&] {
    for (const auto& frame : frames) batch->step(frame, targets_rad);
  });
  return seconds / (ticks * lanes) * 1e6;
}

void measure_each(const std::string& suffix, const std::string& note, std::vector<Figure>& figures) {
  const auto add = [&](const std::string& name, const std::string& what, double value) {
    figures.push_back({"controller_us_" + name + suffix, value, "us",
                       "a tick of one of sixteen different controllers, " + what + note});
  };
  add("supg", "authors'", controller_us("supg"));
  add("supg_residual", "authors' with targets that do not jump",
      controller_us("supg", {"controller.supg.seam.residual_s=0.05"}));
  add("supg_modulated", "authors' whose rate and shape three sensors change",
      controller_us("supg", {R"(controller.supg.modulation.sensors=["pitch","angle.knee","touch"])",
                             "controller.supg.modulation.rate=1", "controller.supg.modulation.shape=1"}));
  add("supg_modulated_reading", "the same with a pattern for each reading",
      controller_us("supg", {R"(controller.supg.modulation.sensors=["pitch","angle.knee","touch"])",
                             "controller.supg.modulation.rate=1", "controller.supg.modulation.shape=1",
                             "controller.supg.modulation.shape_by=reading"}));
  add("mixed", "SUPGs with eight neurons and commands",
      controller_us("supg", {"controller.kind=mixed", "controller.substrate=auto", "command.kind=random"}));
  add("sine", "authors'", controller_us("sine"));
  add("ctrnn", "authors', 17 steps from a cleared state", controller_us("ctrnn"));
  add("ctrnn_kept", "the paper's rule: one step, state kept",
      controller_us("ctrnn", {"controller.ctrnn.state=kept", "controller.ctrnn.steps_per_tick=1"}));
}

}  // namespace

void measure_controllers(std::vector<Figure>& figures) {
  measure_each("", "", figures);
  without_avx512([&] { measure_each("_avx2", ", without AVX-512", figures); });
}

}  // namespace amble::bench
