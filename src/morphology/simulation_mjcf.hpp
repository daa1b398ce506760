#pragma once

#include <string>

#include "amble/robot/spec.hpp"

namespace amble::morphology {

/// The robot as it is simulated, for MuJoCo: what write_mjcf() writes, and contacts and stops as soft as
/// Contact says, an actuator per joint in control order, whose control is the target angle (rad), and the
/// keyframe "start". It is to be stepped `steps_per_tick` times from one control to the next; the time
/// between controls is the custom number "control_period_s".
///
/// The actuators are MuJoCo's springs and dampers with the servos' torque limits. ServoMode::torque with
/// timestep h: kp (target − q) − (kd + kp h) q̇, which is the servo's backward Euler. ServoMode::velocity,
/// ODE's joint motor, reaches its speed at once if the torque suffices; here it is a damper about that speed,
/// which gives all its torque at motor_slip_rad_s away from it.
std::string simulation_mjcf(const robot::RobotSpec& robot, double timestep_s);

inline constexpr int steps_per_tick = 10;
inline constexpr double motor_slip_rad_s = 1.0;

}  // namespace amble::morphology
