#include "amble/trial/scenario.hpp"

#include <algorithm>
#include <cmath>

#include "amble/core/random.hpp"
#include "amble/robot/pose.hpp"

namespace amble::trial {
namespace {

using robot::RobotSpec;

/// Purposes of a scenario's streams. Part of their keys: add at the end, never renumber.
enum class Kind : std::uint32_t {
  start = 0,
  push = 1,
  touch = 2,
  sensors = 3,
  latency = 4,
  place = 5,
  readings = 6,
  commands = 7
};
constexpr std::uint32_t most_kinds = 16;

Stream stream_of(const ScenarioKey& key, Kind kind) {
  return {key.seed, Purpose::trial_noise, key.generation,
          key.episode * most_kinds + static_cast<std::uint32_t>(kind)};
}

/// About R_y(pitch) R_x(roll) for small angles. Without sines, whose last bits differ between CPUs.
Quat small_tilt(double roll_rad, double pitch_rad) {
  const double x = 0.5 * roll_rad, y = 0.5 * pitch_rad;
  const double w = 1.0 / std::sqrt(1.0 + x * x + y * y);
  return {w, w * x, w * y, 0.0};
}

/// Rounded up to a micrometre or so, which hides the last bits of the sines behind it.
double rounded_up(double height_m) {
  constexpr double per_metre = 0x1p20;
  return std::ceil(height_m * per_metre) / per_metre;
}

physics::StartPose draw_start(const NoiseSettings& noise, const RobotSpec& robot, const StartGround& on,
                              Stream stream, Stream places) {
  const auto start = robot::start_poses(robot);
  physics::StartPose pose{.root = {start[0].position_m, start[0].rotation}, .joint_angle_rad = {}};
  const double roll_rad = stream.uniform(-noise.start_tilt_rad, noise.start_tilt_rad);
  const double pitch_rad = stream.uniform(-noise.start_tilt_rad, noise.start_tilt_rad);
  const double higher_m = stream.uniform(0.0, noise.start_height_m);
  pose.root.rotation = small_tilt(roll_rad, pitch_rad) * pose.root.rotation;
  for (const auto& joint : robot.joints)
    pose.joint_angle_rad.push_back(stream.uniform(std::max(-noise.start_joint_rad, joint.lower_rad),
                                                  std::min(noise.start_joint_rad, joint.upper_rad)));

  const auto bodies =
      robot::poses_at(robot, {pose.root.position_m, pose.root.rotation}, pose.joint_angle_rad);
  const double sunk_m = robot::clearance_m(robot, start) - robot::clearance_m(robot, bodies);
  if (sunk_m > 0.0) pose.root.position_m.z += rounded_up(sunk_m);
  if (on.place_m > 0.0) {
    pose.root.position_m.x += places.uniform(-on.place_m, on.place_m);
    pose.root.position_m.y += places.uniform(-on.place_m, on.place_m);
  }
  if (on.ground != nullptr) {
    const auto there =
        robot::poses_at(robot, {pose.root.position_m, pose.root.rotation}, pose.joint_angle_rad);
    pose.root.position_m.z +=
        rounded_up(robot::clearance_m(robot, start) - on.ground->clearance_m(robot, there));
  }
  pose.root.position_m.z += higher_m;
  return pose;
}

/// Uniform over the disc of this radius, by rejection: without sines.
Vec3 draw_in_disc(double radius, Stream& stream) {
  for (;;) {
    const double x = stream.uniform(-1.0, 1.0), y = stream.uniform(-1.0, 1.0);
    if (x * x + y * y <= 1.0) return {radius * x, radius * y, 0.0};
  }
}

std::vector<Scenario::Push> draw_pushes(const NoiseSettings& noise, double mass_kg, int steps,
                                        double timestep_s, Stream stream) {
  std::vector<Scenario::Push> pushes;
  const double interval = noise.push_interval_s / timestep_s;
  for (double begin = 0.0; begin < steps; begin += interval) {
    const double when = begin + stream.uniform() * interval;
    const Vec3 impulse_n_s = draw_in_disc(noise.push_m_s * mass_kg, stream);
    if (when < steps) pushes.push_back({1 + static_cast<int>(when), impulse_n_s});
  }
  return pushes;
}

std::vector<Scenario::TouchFlip> draw_flips(double probability, int legs, int steps, Stream stream) {
  std::vector<Scenario::TouchFlip> flips;
  for (int step = 1; step <= steps; ++step)
    for (int leg = 0; leg < legs; ++leg)
      if (stream.chance(probability)) flips.push_back({step, leg});
  return flips;
}

std::vector<float> draw_offsets(std::size_t count, double largest, Stream& stream) {
  std::vector<float> offsets(count);
  for (float& offset : offsets) offset = static_cast<float>(stream.uniform(-largest, largest));
  return offsets;
}

/// Two episodes that mirror each other both have the stream of the first.
CommandSchedule draw_commands(const CommandSettings& command, int steps, double timestep_s, ScenarioKey key) {
  const bool mirror = command.mirrored && key.episode % 2 == 1;
  if (mirror) --key.episode;
  return drawn_commands(command, steps, timestep_s, stream_of(key, Kind::commands), mirror);
}

}  // namespace

Scenario draw_scenario(const NoiseSettings& noise, const RobotSpec& robot, int steps, double timestep_s,
                       const ScenarioKey& key, const StartGround& start, const CommandSettings& command) {
  Scenario scenario;
  if (command.varies()) scenario.commands = draw_commands(command, steps, timestep_s, key);
  if (noise.first_undisturbed && key.episode == 0) {
    scenario.attitude_sensor_rad.assign(3, -0.0f);  // which leaves even −0 as it is when added
    scenario.joint_sensor_rad.assign(robot.joints.size(), -0.0f);
    return scenario;
  }
  if (noise.disturbs_start() || start.place_m > 0.0)
    scenario.start =
        draw_start(noise, robot, start, stream_of(key, Kind::start), stream_of(key, Kind::place));
  if (noise.push_m_s > 0.0)
    scenario.pushes =
        draw_pushes(noise, robot.total_mass_kg(), steps, timestep_s, stream_of(key, Kind::push));
  if (noise.touch_flip_probability > 0.0)
    scenario.touch_flips = draw_flips(noise.touch_flip_probability, static_cast<int>(robot.legs.size()),
                                      steps, stream_of(key, Kind::touch));
  Stream sensors = stream_of(key, Kind::sensors);
  scenario.attitude_sensor_rad = draw_offsets(3, noise.attitude_sensor_rad, sensors);
  scenario.joint_sensor_rad = draw_offsets(robot.joints.size(), noise.joint_sensor_rad, sensors);
  scenario.latency_ticks = static_cast<int>(
      stream_of(key, Kind::latency).below(static_cast<std::uint32_t>(noise.latency_ticks) + 1));
  scenario.readings = stream_of(key, Kind::readings);
  return scenario;
}

}  // namespace amble::trial
