#pragma once

#include <string>

#include "amble/robot/spec.hpp"

namespace amble::morphology {

/// The robot as it is simulated, for MuJoCo: what write_mjcf() writes, and the timestep, contacts and stops
/// as soft as Contact says, an actuator per joint whose control is the target angle (rad), in control order,
/// and the keyframe "start". Its limits are those of MuJoCo's actuators, which are springs and dampers:
///
/// ServoMode::torque is kp (target − q) − (kd + kp h) q̇ with timestep h. By the integrator "implicit" that is
/// the servo's own law, backward Euler, while its torque is below the limit.
///
/// ServoMode::velocity, ODE's joint motor, reaches its speed within a step if the torque suffices. Here it is
/// a damper about that speed, of `motor_damping` times the inertia at the joint over h: it lags by a step or
/// two.
std::string simulation_mjcf(const robot::RobotSpec& robot, double timestep_s);

inline constexpr double motor_damping = 0.5;

}  // namespace amble::morphology
