#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "amble/io/settings.hpp"
#include "amble/robot/spec.hpp"

namespace amble::damage {

/// What is wrong with a part of a robot.
enum class Kind {
  missing,  ///< a leg: its bodies are gone
  locked,   ///< a joint: held at `angle_rad`, however strong the load
  slack,    ///< a joint: its motor has no torque; its stops, damping, friction and armature remain
  weak,     ///< a joint: its motor has `share` of its largest torque
  numb,     ///< a leg: its touch sensor reads 0
  payload,  ///< a body: a point mass at (x_m, y_m, z_m) in its frame
};
inline constexpr std::array<std::string_view, 6> kind_names{"missing", "locked", "slack",
                                                            "weak",    "numb",   "payload"};

/// One damage of a robot.
struct Part {
  Kind kind = Kind::missing;
  std::string leg = {}, joint = {};        ///< names; what the kind needs
  std::string body = {};                   ///< name; empty: the root
  double angle_rad = 0.0;                  ///< locked: from the start pose, within the joint's stops
  double share = 0.5;                      ///< weak: of the motor's largest torque, 0 … 1
  double mass_kg = 1.0;                    ///< payload: 1e−9 … 1e6
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;  ///< payload: in the body's frame, −100 … 100
  double from_s = 0.0;                     ///< since when, from the trial's beginning, 0 … 1e9

  void describe(io::SettingsVisitor& visitor);
};

/// What is wrong with the robot in a trial; by default nothing. Damages accumulate; of two that contradict
/// each other in a joint, the one that begins later counts, and of two that begin together the last.
struct Settings {
  std::vector<Part> parts;

  void describe(io::SettingsVisitor& visitor);
  /// Throws SettingError for names that the robot does not have, names that a kind does not need, an angle
  /// beyond the joint's stops, slack or weak joints without a motor, and legs that cannot be removed, or all.
  void validate(const robot::RobotSpec& robot) const;

  bool is_default() const { return parts.empty(); }
  /// Whether the robot itself is changed, not its sensors alone.
  bool changes_body() const;
};

}  // namespace amble::damage
