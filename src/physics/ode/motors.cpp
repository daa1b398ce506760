#include "amble/physics/ode/motors.hpp"

#include <algorithm>

#include "amble/core/index.hpp"

namespace amble::physics::ode {
namespace {

using robot::Joint;
using robot::RobotSpec;
using robot::ServoMode;

/// A torque servo leaves ODE's joint motor unpowered.
double motor_limit(const Joint& joint) {
  return joint.servo.mode == ServoMode::velocity ? joint.servo.max_torque_nm : 0.0;
}

}  // namespace

Motors::Motors(const RobotSpec& robot, const World& world)
    : joints_(robot.joints), angles_rad_(robot.joints.size(), 0.0) {
  for (int b = 1; b < static_cast<int>(robot.bodies.size()); ++b) {
    const std::vector<int> chain = robot.joints_of_body(b);
    Drive drive{.joint = world.joints()[to_index(b)], .first = chain[0]};
    if (chain.size() == 1) {
      dJointSetHingeParam(drive.joint, dParamFMax, motor_limit(joints_[to_index(chain[0])]));
    } else {
      drive.second = chain[1];
      dJointSetUniversalParam(drive.joint, dParamFMax1, motor_limit(joints_[to_index(chain[0])]));
      dJointSetUniversalParam(drive.joint, dParamFMax2, motor_limit(joints_[to_index(chain[1])]));
    }
    drives_.push_back(drive);
  }
}

void Motors::read(LaneArray& angles_rad) {
  for (const Drive& drive : drives_) {
    if (drive.second < 0) {
      angles_rad_[to_index(drive.first)] = dJointGetHingeAngle(drive.joint);
    } else {
      dJointGetUniversalAngles(drive.joint, &angles_rad_[to_index(drive.first)],
                               &angles_rad_[to_index(drive.second)]);
    }
  }
  for (int j = 0; j < angles_rad.rows(); ++j)
    angles_rad.at(j, 0) = static_cast<float>(angles_rad_[to_index(j)]);
}

void Motors::drive(const LaneArray& targets_rad) {
  for (const Drive& drive : drives_) {
    if (drive.second < 0) {
      drive_hinge(drive, target(drive.first, targets_rad));
    } else {
      drive_universal(drive, target(drive.first, targets_rad), target(drive.second, targets_rad));
    }
  }
}

std::optional<double> Motors::torque_beforehand(const Drive& drive, int joint,
                                                const LaneArray& targets_rad) const {
  const Joint& spec = joints_[to_index(joint)];
  const double target_rad = target(joint, targets_rad), angle_rad = angles_rad_[to_index(joint)];
  if (spec.servo.mode == ServoMode::torque)
    return torque_command(joint, target_rad, rate_rad_s(drive, joint));
  const bool at_lower = angle_rad <= spec.lower_rad, at_upper = angle_rad >= spec.upper_rad;
  if (!at_lower && !at_upper) return std::nullopt;
  const double speed = speed_command(joint, target_rad);
  const bool forward = speed > 0.0 || (speed == 0.0 && !at_lower);
  return forward ? spec.servo.max_torque_nm : -spec.servo.max_torque_nm;
}

double Motors::target(int joint, const LaneArray& targets_rad) const {
  return std::clamp(static_cast<double>(targets_rad.at(joint, 0)), joints_[to_index(joint)].lower_rad,
                    joints_[to_index(joint)].upper_rad);
}

double Motors::rate_rad_s(const Drive& drive, int joint) const {
  if (drive.second < 0) return dJointGetHingeAngleRate(drive.joint);
  return joint == drive.first ? dJointGetUniversalAngle1Rate(drive.joint)
                              : dJointGetUniversalAngle2Rate(drive.joint);
}

double Motors::speed_command(int joint, double target_rad) const {
  return joints_[to_index(joint)].servo.gain_per_s * (target_rad - angles_rad_[to_index(joint)]);
}

double Motors::torque_command(int joint, double target_rad, double speed_rad_s) const {
  const auto& servo = joints_[to_index(joint)].servo;
  if (servo.mode == ServoMode::velocity) return 0.0;
  const double torque =
      servo.kp_nm_per_rad * (target_rad - angles_rad_[to_index(joint)]) - servo.kd_nm_s_per_rad * speed_rad_s;
  return std::clamp(torque, -servo.max_torque_nm, servo.max_torque_nm);
}

void Motors::drive_hinge(const Drive& drive, double target_rad) const {
  if (joints_[to_index(drive.first)].servo.mode == ServoMode::velocity) {
    dJointSetHingeParam(drive.joint, dParamVel, speed_command(drive.first, target_rad));
  } else {
    dJointAddHingeTorque(drive.joint,
                         torque_command(drive.first, target_rad, rate_rad_s(drive, drive.first)));
  }
}

void Motors::drive_universal(const Drive& drive, double target1_rad, double target2_rad) const {
  // A motor with dParamFMax 0 ignores its speed, so both modes can share one joint.
  dJointSetUniversalParam(drive.joint, dParamVel1, speed_command(drive.first, target1_rad));
  dJointSetUniversalParam(drive.joint, dParamVel2, speed_command(drive.second, target2_rad));
  const bool torque1 = joints_[to_index(drive.first)].servo.mode == ServoMode::torque;
  const bool torque2 = joints_[to_index(drive.second)].servo.mode == ServoMode::torque;
  if (torque1 || torque2) {
    dJointAddUniversalTorques(drive.joint,
                              torque_command(drive.first, target1_rad, rate_rad_s(drive, drive.first)),
                              torque_command(drive.second, target2_rad, rate_rad_s(drive, drive.second)));
  }
}

}  // namespace amble::physics::ode
