#include "amble/physics/ode/torque_meter.hpp"

#include "amble/core/index.hpp"

namespace amble::physics::ode {
namespace {

Vec3 vec3(const dReal* v) {
  return {v[0], v[1], v[2]};
}

}  // namespace

TorqueMeter::TorqueMeter(const robot::RobotSpec& robot, const Motors& motors)
    : motors_(motors),
      feedback_(motors.bearings().size()),
      frames_(motors.bearings().size()),
      known_nm_(robot.joints.size()) {
  for (std::size_t d = 0; d < feedback_.size(); ++d)
    dJointSetFeedback(motors.bearings()[d].id, &feedback_[d]);
}

void TorqueMeter::before_step(const LaneArray& targets_rad) {
  for (std::size_t d = 0; d < frames_.size(); ++d) {
    const Bearing& bearing = motors_.bearings()[d];
    const Vec3 com = vec3(dBodyGetPosition(dJointGetBody(bearing.id, 0)));
    dVector3 anchor, axis1, axis2{};
    known_nm_[to_index(bearing.first)] = motors_.torque_beforehand(bearing.first, targets_rad);
    if (bearing.second < 0) {
      dJointGetHingeAnchor(bearing.id, anchor);
      dJointGetHingeAxis(bearing.id, axis1);
    } else {
      known_nm_[to_index(bearing.second)] = motors_.torque_beforehand(bearing.second, targets_rad);
      dJointGetUniversalAnchor(bearing.id, anchor);
      dJointGetUniversalAxis1(bearing.id, axis1);
      dJointGetUniversalAxis2(bearing.id, axis2);
    }
    frames_[d] = {vec3(anchor) - com, vec3(axis1), vec3(axis2)};
  }
}

void TorqueMeter::after_step(LaneArray& torques_nm) const {
  const auto put = [&](int joint, double solved_nm) {
    torques_nm.at(joint, 0) = static_cast<float>(known_nm_[to_index(joint)].value_or(solved_nm));
  };
  for (std::size_t d = 0; d < frames_.size(); ++d) {
    const Bearing& bearing = motors_.bearings()[d];
    const JointFrame& frame = frames_[d];
    // About the anchor r, τ = t1 − r × f1: the bearing's force acts there, so only motors, stops and what
    // keeps the axes aligned remain, and the latter is perpendicular to both axes. On the first body and
    // along ODE's axes the sign is that of the child against its parent (world.cpp).
    const Vec3 torque = vec3(feedback_[d].t1) - cross(frame.anchor_m, vec3(feedback_[d].f1));
    const double along1 = dot(torque, frame.axis1);
    if (bearing.second < 0) {
      put(bearing.first, along1);
      continue;
    }
    // τ = τ1 a1 + τ2 a2, so τ · a1 = τ1 + c τ2 and τ · a2 = c τ1 + τ2 with c = a1 · a2, which soft
    // constraints let differ from 0 by some thousandths.
    const double along2 = dot(torque, frame.axis2), c = dot(frame.axis1, frame.axis2);
    const double inverse_determinant = 1.0 / (1.0 - c * c);
    put(bearing.first, inverse_determinant * (along1 - c * along2));
    put(bearing.second, inverse_determinant * (along2 - c * along1));
  }
}

}  // namespace amble::physics::ode
