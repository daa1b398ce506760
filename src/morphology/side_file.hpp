#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "amble/io/settings.hpp"
#include "amble/robot/spec.hpp"

namespace amble::morphology {

/// Names of a leg's parts in the model.
struct LegNames {
  std::vector<std::string> foot;    ///< its shapes, at least one
  std::vector<std::string> joints;  ///< one per joint type; empty: the leg has none of that type
};

/// The TOML file beside a model: all that MJCF and URDF cannot express. robots/README.md has an example,
/// docs/SETTINGS.md all keys, which are those of describe_side_file().
struct SideFile {
  std::string name;
  std::filesystem::path model;
  std::vector<std::string> legs;
  std::vector<std::string> joint_types;
  std::vector<LegNames> names;       ///< one per leg
  std::vector<std::string> held;     ///< joints of no leg, held at their start angle by their servo
  std::vector<std::string> passive;  ///< joints without a motor, in a leg or not
  std::vector<std::string> fixed;    ///< joints that are welded at their start angle
  std::vector<robot::Servo> servos;  ///< leg by leg and type by type, whether or not the leg has the joint
  std::vector<robot::Servo> held_servos;  ///< one per held joint
  /// In the order of `servos`, as the model counts angles; none: from stop to stop.
  std::vector<std::optional<robot::AngleRange>> commands;
  std::string start;                        ///< keyframe; empty: the model's default pose
  std::map<std::string, double> start_rad;  ///< start angles by joint, as the model counts, beside `start`
  robot::Contact contact;
  std::optional<Quat> start_rotation;  ///< of the root in the world; none: as the model has it
  double root_height_m = 0.0;          ///< of the root's frame; 0: as the model has it
  double fall_height_m = 0.0;
  double fall_above_m = std::numeric_limits<double>::infinity();
  double fall_tilt_rad = std::numeric_limits<double>::infinity();
  bool self_collision = false;
  bool keep_model = false;  ///< whether the robot carries the model itself, for the engine mujoco-model
};

/// All keys that a robot file may have, with what they mean and what is allowed; LEG, TYPE and JOINT stand
/// for names of the robot's parts.
void describe_side_file(io::SettingsVisitor& visitor);

/// Throws UserError naming file, key, value and what was expected.
SideFile read_side_file(const std::filesystem::path& path);
/// The same of a text; `name` is what messages call it, and folders are relative to it.
SideFile parse_side_file(std::string_view text, const std::filesystem::path& name);

}  // namespace amble::morphology
