#include "amble/controllers/differential.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "amble/controllers/joint_range.hpp"
#include "amble/controllers/joint_type.hpp"
#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/robot/legs.hpp"
#include "amble/robot/pose.hpp"

namespace amble::controllers {
namespace {

using Steered = DifferentialArchitecture::Steered;
using Factor = DifferentialArchitecture::Factor;

constexpr int factors = 4;
constexpr std::array<const char*, factors> factor_names{"swing.left", "swing.right", "swing.between",
                                                        "swing.others"};

/// Differences up to this are rounding.
constexpr double same_m = 1e-6;

/// How far a leg's foot moves forward per radian of a joint in the start pose, m, without its sign.
double forward_m_per_rad(const robot::RobotSpec& robot, const robot::Leg& leg, int joint_index,
                         const std::vector<robot::Pose>& poses) {
  const robot::Joint& joint = robot.joints[to_index(joint_index)];
  const robot::Pose& pose = poses[to_index(joint.body)];
  const Vec3 arm_m = robot::foot_m(robot, leg, poses) - pose * joint.anchor_m;
  return std::abs(cross(rotate(pose.rotation, joint.axis), arm_m).x);
}

/// The leg's driven joints in the order of their types.
std::vector<int> driven_joints(const robot::RobotSpec& robot, const robot::Leg& leg) {
  std::vector<int> joints;
  for (const int joint : leg.joints)
    if (joint >= 0 && robot.joints[to_index(joint)].driven()) joints.push_back(joint);
  return joints;
}

std::vector<int> found_swing_joint(const robot::RobotSpec& robot, const robot::Leg& leg,
                                   const std::vector<robot::Pose>& poses) {
  constexpr double least_m = 1e-3;
  const std::vector<int> joints = driven_joints(robot, leg);
  double most_m = 0.0;
  for (const int joint : joints) most_m = std::max(most_m, forward_m_per_rad(robot, leg, joint, poses));
  if (most_m < least_m) return {};
  for (const int joint : joints)
    if (forward_m_per_rad(robot, leg, joint, poses) >= most_m - same_m) return {joint};
  return {};
}

std::vector<int> listed_swing_joints(const robot::RobotSpec& robot, const robot::Leg& leg,
                                     const std::vector<std::string>& types) {
  std::vector<int> listed;
  for (std::size_t type = 0; type < leg.joints.size(); ++type) {
    const int joint = leg.joints[type];
    if (joint >= 0 && robot.joints[to_index(joint)].driven() &&
        std::ranges::find(types, robot.joint_types[type]) != types.end())
      listed.push_back(joint);
  }
  return listed;
}

void check_types(const robot::RobotSpec& robot, const std::vector<std::string>& types) {
  for (std::size_t i = 0; i < types.size(); ++i)
    joint_type_index(robot, types[i], fmt::format("controller.differential.joint_types[{}]", i), types[i]);
}

/// What is commanded, as factors.
class Steering {
 public:
  Steering(const DifferentialSettings& settings, double timestep_s)
      : turn_gain_(static_cast<float>(settings.turn_gain)),
        heading_gain_(static_cast<float>(settings.heading_gain)),
        full_speed_m_s_(static_cast<float>(settings.full_speed_m_s)),
        most_change_(settings.change_s > timestep_s ? static_cast<float>(timestep_s / settings.change_s)
                                                    : 2.0f) {}

  /// Largest change in a tick.
  float most_change() const { return most_change_; }

  std::array<float, factors> wanted(const robot::SensorFrame& sensors, int lane) const {
    const bool steers_speed = full_speed_m_s_ > 0.0f;
    const bool stops = steers_speed && sensors.command_stop.at(0, lane) > 0.5f;
    float turn = sensors.command.at(1, lane);
    if (heading_gain_ > 0.0f) turn += heading_gain_ * sensors.heading_error_rad.at(0, lane);
    const float speed = stops ? 0.0f
                        : steers_speed
                            ? std::clamp(sensors.command.at(0, lane) / full_speed_m_s_, -1.0f, 1.0f)
                            : 1.0f;
    const float inner = speed * std::max(-1.0f, 1.0f - turn_gain_ * std::abs(turn));
    // Backwards, the legs on the side that the robot turns to go the longer way.
    const float left = speed < 0.0f ? -turn : turn;
    return {left > 0.0f ? inner : speed, left < 0.0f ? inner : speed, speed, stops ? 0.0f : 1.0f};
  }

 private:
  float turn_gain_, heading_gain_, full_speed_m_s_, most_change_;
};

class DifferentialBatch final : public Batch {
 public:
  DifferentialBatch(std::unique_ptr<Batch> walker, const Steering& steering, std::vector<Steered> joints)
      : walker_(std::move(walker)),
        steering_(steering),
        joints_(std::move(joints)),
        factor_(factors, walker_->lanes()),
        is_new_(to_index(walker_->lanes()), true) {}

  int lanes() const override { return walker_->lanes(); }
  void load(int lane, const Parameters& parameters) override {
    walker_->load(lane, parameters);
    is_new_[to_index(lane)] = true;
    for (int f = 0; f < factors; ++f) factor_.at(f, lane) = 1.0f;
  }

  void step(const robot::SensorFrame& sensors, LaneArray& targets_rad) override {
    AMBLE_CHECK(sensors.command.rows() == 2 && sensors.command.lanes() == lanes(), "commands are sensed");
    walker_->step(sensors, targets_rad);
    for (int lane = 0; lane < lanes(); ++lane) follow(sensors, lane);
    for (const Steered& joint : joints_) {
      float* const target_rad = targets_rad.row(joint.joint);
      const float* const factor = factor_.row(joint.factor);
      for (int lane = 0; lane < lanes(); ++lane) {
        const float scaled = joint.centre_rad + (target_rad[lane] - joint.centre_rad) * factor[lane];
        if (factor[lane] != 1.0f) target_rad[lane] = std::clamp(scaled, joint.lower_rad, joint.upper_rad);
      }
    }
  }

  std::vector<std::string> state_names() const override {
    std::vector<std::string> names = walker_->state_names();
    names.insert(names.end(), factor_names.begin(), factor_names.end());
    return names;
  }
  void state(int lane, std::span<float> values) const override {
    AMBLE_CHECK(values.size() >= factors, "as many as state_names()");
    const std::size_t own = values.size() - factors;
    walker_->state(lane, values.first(own));
    for (int f = 0; f < factors; ++f) values[own + to_index(f)] = factor_.at(f, lane);
  }
  std::vector<std::size_t> events() const override { return walker_->events(); }

 private:
  void follow(const robot::SensorFrame& sensors, int lane) {
    const auto wanted = steering_.wanted(sensors, lane);
    const float most = is_new_[to_index(lane)] ? 2.0f : steering_.most_change();
    is_new_[to_index(lane)] = false;
    for (int f = 0; f < factors; ++f) {
      float& factor = factor_.at(f, lane);
      factor = std::clamp(wanted[to_index(f)], factor - most, factor + most);
    }
  }

  std::unique_ptr<Batch> walker_;
  Steering steering_;
  std::vector<Steered> joints_;
  LaneArray factor_;          ///< factors × lanes
  std::vector<bool> is_new_;  ///< by lane: before its first tick
};

}  // namespace

SwingJoints swing_joints(const robot::RobotSpec& robot, const std::vector<std::string>& joint_types) {
  check_types(robot, joint_types);
  SwingJoints found;
  const std::vector<robot::Pose> poses = robot::start_poses(robot);
  const std::vector<Vec3> hips_m = robot::hips_m(robot, poses);
  double mean_m = 0.0;
  for (const Vec3& hip_m : hips_m) mean_m += hip_m.y / static_cast<double>(hips_m.size());
  for (std::size_t leg = 0; leg < robot.legs.size(); ++leg) {
    found.of_legs.push_back(joint_types.empty() ? found_swing_joint(robot, robot.legs[leg], poses)
                                                : listed_swing_joints(robot, robot.legs[leg], joint_types));
    const double left_m = hips_m[leg].y - mean_m;
    found.sides.push_back(left_m > same_m ? 1 : left_m < -same_m ? -1 : 0);
  }
  return found;
}

DifferentialArchitecture::DifferentialArchitecture(std::unique_ptr<const Architecture> walker,
                                                   const DifferentialSettings& settings,
                                                   const robot::RobotSpec& robot, double timestep_s)
    : walker_(std::move(walker)), settings_(settings), timestep_s_(timestep_s) {
  if (settings.heading_gain > 0.0 && settings.turn_gain <= 0.0)
    fail_setting(
        {"controller.differential.heading_gain", "controller.differential.turn_gain"},
        "controller.differential.heading_gain = {}: without a turn_gain nothing turns; expected 0, or "
        "a turn_gain of more than 0",
        settings.heading_gain);
  const SwingJoints swings = swing_joints(robot, settings.joint_types);
  if (std::ranges::find(swings.sides, 1) == swings.sides.end())
    fail_setting({"controller.differential.turn_gain"},
                 "controller.differential: the robot has no left and right legs; expected hips on two sides");
  if (std::ranges::all_of(swings.of_legs, &std::vector<int>::empty))
    fail_setting(
        {"controller.differential.joint_types"},
        "controller.differential.joint_types: no driven joint swings a leg forward and back; expected "
        "the types of those that do");
  const std::vector<JointRange> ranges = joint_ranges(robot);
  for (std::size_t leg = 0; leg < robot.legs.size(); ++leg)
    for (const int joint : driven_joints(robot, robot.legs[leg])) {
      const std::vector<int>& swing = swings.of_legs[leg];
      const bool does_swing = std::ranges::find(swing, joint) != swing.end();
      const int side = swings.sides[leg];
      const JointRange& range = ranges[to_index(joint)];
      joints_.push_back({.joint = joint,
                         .factor = !does_swing ? others
                                   : side > 0  ? left
                                   : side < 0  ? right
                                               : between,
                         .centre_rad = settings.about == SwingCentre::middle
                                           ? range.at(0.5)
                                           : held_target_rad(robot.joints[to_index(joint)]),
                         .lower_rad = range.at(0.0),
                         .upper_rad = range.at(1.0)});
    }
}

float DifferentialArchitecture::most_change() const {
  return Steering(settings_, timestep_s_).most_change();
}

std::unique_ptr<Batch> DifferentialArchitecture::make_batch(int lanes) const {
  return std::make_unique<DifferentialBatch>(walker_->make_batch(lanes), Steering(settings_, timestep_s_),
                                             joints_);
}

robot::ExtraSenses DifferentialArchitecture::extra_senses() const {
  robot::ExtraSenses senses = walker_->extra_senses();
  senses.command = true;
  senses.heading_error |= settings_.heading_gain > 0.0;
  return senses;
}

bool DifferentialArchitecture::reads(const substrate::Sensor& sensor) const {
  using Kind = substrate::Sensor::Kind;
  const bool steers_speed = settings_.full_speed_m_s > 0.0, turns = settings_.turn_gain > 0.0;
  switch (sensor.kind) {
    case Kind::command_stop:
    case Kind::command_speed:
      if (steers_speed) return true;
      break;
    case Kind::command_turn:
      if (turns) return true;
      break;
    case Kind::heading_error:
      if (settings_.heading_gain > 0.0) return true;
      break;
    default:
      break;
  }
  return walker_->reads(sensor);
}

}  // namespace amble::controllers
