#pragma once

#include <string>
#include <vector>

#include "amble/robot/spec.hpp"

namespace amble::morphology {

/// A robot as an MJCF model (the XML format of MuJoCo), with a ground plane at z = 0. MuJoCo numbers what it
/// reads in the order of the text; the lists map that order to indices of the RobotSpec. The world's ground
/// is MuJoCo's geom 0, the root's free joint its joint 0 and the world its body 0, so the part at position i
/// has MuJoCo's number i + 1.
struct Mjcf {
  std::string text;
  std::vector<int> bodies, joints, geoms;
  std::vector<std::string> joint_names;  ///< unique, as in the text; in the order of `joints`
};

/// XML that a model gets beside the robot's own parts.
struct MjcfAdditions {
  std::string option = R"(timestep="0.01")";  ///< attributes of <option> beside gravity
  /// Attributes of joints and geoms, by index in the RobotSpec; or empty. Each begins with a space.
  std::vector<std::string> joints = {}, geoms = {};
  std::string sections = {};  ///< behind the world, in lines
};

/// What files that amble writes begin with, before the text, so that a model of somebody else is not
/// replaced.
inline const std::string written_mjcf_start = "<!-- Written by amble. -->\n";

/// Writes bodies, inertias, joints with their ranges, geoms and friction; all numbers read back to the same
/// bits. Loaded with a TOML side file it is the same robot. MJCF cannot express the servos, the fall height
/// and the contact's erp and cfm. Infinite friction is written as `grip`.
Mjcf write_mjcf(const robot::RobotSpec& robot, const MjcfAdditions& additions = {});

/// Coefficient of friction that represents infinity in MuJoCo.
inline constexpr double grip = 1e4;

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
