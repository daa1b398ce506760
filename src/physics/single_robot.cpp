#include "amble/physics/single_robot.hpp"

#include <cmath>

#include "amble/core/check.hpp"

namespace amble::physics {
namespace {

bool has_nan(const LaneArray& targets_rad) {
  bool found = false;
  for (int j = 0; j < targets_rad.rows(); ++j) found = found || std::isnan(targets_rad.at(j, 0));
  return found;
}

}  // namespace

SingleRobotEngine::SingleRobotEngine(const robot::RobotSpec& robot, const EngineSettings& settings)
    : robot_(robot),
      with_torques_(settings.torques),
      with_loads_(settings.loads),
      level_(robot::horizontal_frame(robot.gravity_m_s2)),
      tilted_(level_ != Quat()),
      turned_(robot.bodies[0].rotation != Quat()) {
  const int joints = static_cast<int>(robot.joints.size());
  sensors_.joint_angle_rad = LaneArray(joints, 1);
  sensors_.touch = LaneArray(static_cast<int>(robot.legs.size()), 1);
  sensors_.attitude_rad = LaneArray(3, 1);
  if (with_torques_) torques_nm_ = LaneArray(joints, 1);
  if (with_loads_) loads_n_ = LaneArray(static_cast<int>(robot.legs.size()), 1);
}

void SingleRobotEngine::check_lane(int lane) {
  AMBLE_CHECK(lane == 0, "this engine has one lane");
}

void SingleRobotEngine::retire(int lane) {
  check_lane(lane);
  stepping_ = false;
}

bool SingleRobotEngine::healthy(int lane) const {
  check_lane(lane);
  return healthy_;
}

void SingleRobotEngine::place_here() {
  torques_nm_.set_lane(0, 0.0f);
  loads_n_.set_lane(0, 0.0f);
  stepping_ = true;
  healthy_ = true;
}

bool SingleRobotEngine::can_step(const LaneArray& targets_rad) {
  if (!stepping_ || !healthy_) return false;
  AMBLE_CHECK(targets_rad.rows() == sensors_.joint_angle_rad.rows() && targets_rad.lanes() == 1, "targets");
  healthy_ = !has_nan(targets_rad);
  return healthy_;
}

void SingleRobotEngine::check_pushable(int lane) const {
  check_lane(lane);
  AMBLE_CHECK(stepping_, "only a placed robot can be pushed");
}

void SingleRobotEngine::sense_attitude(const Quat& rotation) {
  const Quat turned = turned_ ? robot_.turned(rotation) : rotation;
  const RollPitchYaw attitude = roll_pitch_yaw(tilted_ ? conjugate(level_) * turned : turned);
  sensors_.attitude_rad.at(0, 0) = static_cast<float>(attitude.roll_rad);
  sensors_.attitude_rad.at(1, 0) = static_cast<float>(attitude.pitch_rad);
  sensors_.attitude_rad.at(2, 0) = static_cast<float>(attitude.yaw_rad);
}

}  // namespace amble::physics
