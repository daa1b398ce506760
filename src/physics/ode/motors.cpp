#include "amble/physics/ode/motors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "amble/core/index.hpp"

namespace amble::physics::ode {
namespace {

using robot::Joint;
using robot::RobotSpec;
using robot::ServoMode;

constexpr double turn_rad = 2.0 * std::numbers::pi;

void set(dJointID bearing, int axis, int parameter, double value) {
  if (axis == 0)
    dJointSetHingeParam(bearing, parameter, value);
  else
    dJointSetUniversalParam(bearing, parameter + dParamGroup * (axis - 1), value);
}

Vec3 vec3(const dReal* v) {
  return {v[0], v[1], v[2]};
}

}  // namespace

Motors::Motors(const RobotSpec& robot, const World& world, double timestep_s)
    : joints_(robot.joints),
      bearings_(world.bearings()),
      timestep_s_(timestep_s),
      axes_(robot.joints.size()),
      angles_rad_(robot.joints.size(), 0.0) {
  for (const Joint& joint : joints_) servos_.push_back(joint.acting_servo());
  for (const Bearing& bearing : bearings_) {
    add_axis(world, bearing, bearing.second < 0 ? 0 : 1);
    if (bearing.second >= 0) add_axis(world, bearing, 2);
  }
}

void Motors::add_axis(const World& world, const Bearing& bearing, int number) {
  const int j = number == 2 ? bearing.second : bearing.first;
  const Joint& joint = joints_[to_index(j)];
  Axis& axis = axes_[to_index(j)];
  axis = {.bearing = bearing.id, .number = number};
  axis.many_turns = joint.lower_rad <= -std::numbers::pi || joint.upper_rad >= std::numbers::pi;
  const robot::Servo& servo = servos_[to_index(j)];
  const bool velocity = servo.mode == ServoMode::velocity;
  const bool idle = !velocity && stiffness(j) == 0.0;
  set(axis.bearing, number, dParamFMax, idle ? 0.0 : servo.max_torque_nm);
  if (!velocity && !idle) set(axis.bearing, number, dParamCFM, 1.0 / stiffness(j));
  const double inertia = joint.armature_kg_m2 / timestep_s_ + joint.damping_nm_s_per_rad;
  if (inertia > 0.0) axis.inertia = new_motor(world, axis, dInfinity, 1.0 / inertia);
  if (joint.friction_loss_nm > 0.0) new_motor(world, axis, joint.friction_loss_nm, dWorldGetCFM(world.id()));
}

dJointID Motors::new_motor(const World& world, const Axis& axis, double max_torque_nm,
                           double softness) const {
  const dJointID motor = dJointCreateAMotor(world.id(), nullptr);
  // Child first, parent second, as in a hinge; the axes of a universal joint are reversed (world.cpp).
  const bool hinge = axis.number == 0;
  const dBodyID child = dJointGetBody(axis.bearing, hinge ? 0 : 1),
                parent = dJointGetBody(axis.bearing, hinge ? 1 : 0);
  dVector3 along{};
  if (axis.number == 0) dJointGetHingeAxis(axis.bearing, along);
  if (axis.number == 1) dJointGetUniversalAxis1(axis.bearing, along);
  if (axis.number == 2) dJointGetUniversalAxis2(axis.bearing, along);
  const double sign = hinge ? 1.0 : -1.0;
  const int fixed_to = axis.number == 1 ? 2 : 1;  // the first axis of a universal joint turns with the parent
  dJointAttach(motor, child, parent);
  dJointSetAMotorNumAxes(motor, 1);
  dJointSetAMotorAxis(motor, 0, fixed_to, sign * along[0], sign * along[1], sign * along[2]);
  dJointSetAMotorParam(motor, dParamFMax, max_torque_nm);
  dJointSetAMotorParam(motor, dParamCFM, softness);
  dJointSetAMotorParam(motor, dParamVel, 0.0);
  return motor;
}

void Motors::start_at(std::span<const double> angles_rad) {
  angles_rad_.assign(angles_rad.begin(), angles_rad.end());
}

std::vector<double> Motors::speeds_rad_s() const {
  std::vector<double> speeds;
  for (const Axis& axis : axes_) speeds.push_back(rate_rad_s(axis));
  return speeds;
}

void Motors::read(LaneArray& angles_rad) {
  for (std::size_t j = 0; j < axes_.size(); ++j) {
    const auto& [bearing, number, inertia, many_turns] = axes_[j];
    double angle_rad = number == 0   ? dJointGetHingeAngle(bearing)
                       : number == 1 ? dJointGetUniversalAngle1(bearing)
                                     : dJointGetUniversalAngle2(bearing);
    // ODE's angle is in ± π; the joint has not turned by more than π since the last step.
    if (many_turns) angle_rad += turn_rad * std::round((angles_rad_[j] - angle_rad) / turn_rad);
    angles_rad_[j] = angle_rad;
    angles_rad.at(static_cast<int>(j), 0) = static_cast<float>(angle_rad);
  }
}

void Motors::drive(const LaneArray& targets_rad) {
  for (int j = 0; j < static_cast<int>(axes_.size()); ++j) {
    const Axis& axis = axes_[to_index(j)];
    if (axis.many_turns) watch_stops(j);
    drive_joint(j, target(j, targets_rad));
    if (axis.inertia == nullptr) continue;
    // −(a/h) (q̇⁺ − q̇) − d q̇⁺ = −(a/h + d) (q̇⁺ − speed).
    const Joint& joint = joints_[to_index(j)];
    const double inertia = joint.armature_kg_m2 / timestep_s_;
    dJointSetAMotorParam(axis.inertia, dParamVel,
                         inertia / (inertia + joint.damping_nm_s_per_rad) * rate_rad_s(axis));
  }
}

/// Gives ODE the stops that lie within the turn that it sees the joint in.
void Motors::watch_stops(int joint) const {
  const Axis& axis = axes_[to_index(joint)];
  const Joint& spec = joints_[to_index(joint)];
  const double turns_rad = turn_rad * std::round(angles_rad_[to_index(joint)] / turn_rad);
  const double lower_rad = spec.lower_rad - turns_rad, upper_rad = spec.upper_rad - turns_rad;
  set(axis.bearing, axis.number, dParamLoStop, lower_rad > -std::numbers::pi ? lower_rad : -dInfinity);
  set(axis.bearing, axis.number, dParamHiStop, upper_rad < std::numbers::pi ? upper_rad : dInfinity);
}

std::optional<double> Motors::torque_beforehand(int joint, const LaneArray& targets_rad) const {
  if (!joints_[to_index(joint)].has_motor()) return 0.0;
  if (!at_stop(joint)) return std::nullopt;
  const double target_rad = target(joint, targets_rad), angle_rad = angles_rad_[to_index(joint)];
  const auto& servo = servos_[to_index(joint)];
  if (servo.mode == ServoMode::torque) return torque_at_stop(joint, target_rad);
  const double speed = servo.gain_per_s * (target_rad - angle_rad);
  const bool forward = speed > 0.0 || (speed == 0.0 && !(angle_rad <= joints_[to_index(joint)].lower_rad));
  return forward ? servo.max_torque_nm : -servo.max_torque_nm;
}

double Motors::target(int joint, const LaneArray& targets_rad) const {
  const Joint& own = joints_[to_index(joint)];
  if (!own.has_motor()) return own.rest_rad;
  return std::clamp(static_cast<double>(targets_rad.at(joint, 0)), own.lower_rad, own.upper_rad);
}

bool Motors::at_stop(int joint) const {
  const double angle_rad = angles_rad_[to_index(joint)];
  return angle_rad <= joints_[to_index(joint)].lower_rad || angle_rad >= joints_[to_index(joint)].upper_rad;
}

double Motors::torque_at_stop(int joint, double target_rad) const {
  const auto& servo = servos_[to_index(joint)];
  return std::clamp(servo.kp_nm_per_rad * (target_rad - angles_rad_[to_index(joint)]), -servo.max_torque_nm,
                    servo.max_torque_nm);
}

double Motors::rate_rad_s(const Axis& axis) const {
  if (axis.number == 0) return dJointGetHingeAngleRate(axis.bearing);
  return axis.number == 1 ? dJointGetUniversalAngle1Rate(axis.bearing)
                          : dJointGetUniversalAngle2Rate(axis.bearing);
}

double Motors::stiffness(int joint) const {
  const auto& servo = servos_[to_index(joint)];
  return servo.kp_nm_per_rad * timestep_s_ + servo.kd_nm_s_per_rad;
}

void Motors::drive_joint(int joint, double target_rad) const {
  const auto& [bearing, number, inertia, many_turns] = axes_[to_index(joint)];
  const auto& servo = servos_[to_index(joint)];
  const double error_rad = target_rad - angles_rad_[to_index(joint)];
  if (servo.mode == ServoMode::velocity) {
    set(bearing, number, dParamVel, servo.gain_per_s * error_rad);
    return;
  }
  if (stiffness(joint) == 0.0) return;
  const bool stopped = at_stop(joint);
  set(bearing, number, dParamFMax, stopped ? 0.0 : servo.max_torque_nm);
  set(bearing, number, dParamVel, servo.kp_nm_per_rad * error_rad / stiffness(joint));
  if (!stopped) return;
  const double torque_nm = torque_at_stop(joint, target_rad);
  if (number == 0)
    dJointAddHingeTorque(bearing, torque_nm);
  else
    dJointAddUniversalTorques(bearing, number == 1 ? torque_nm : 0.0, number == 2 ? torque_nm : 0.0);
}

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
