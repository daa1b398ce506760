#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "amble/robot/spec.hpp"

namespace amble::morphology {

/// Names of a leg's parts in the model.
struct LegNames {
  std::string foot;
  std::vector<std::string> joints;  ///< one per joint type
};

/// The TOML file beside a model: all that MJCF and URDF cannot express. robots/README.md describes it key by
/// key.
struct SideFile {
  std::string name;
  std::filesystem::path model;
  std::vector<std::string> legs;
  std::vector<std::string> joint_types;
  std::vector<LegNames> names;       ///< one per leg
  std::vector<robot::Servo> servos;  ///< one per joint, in control order
  robot::Contact contact;
  double root_height_m = 0.0;  ///< of the root's frame; 0: as the model has it
  double fall_height_m = 0.0;
  bool self_collision = false;
};

/// Throws UserError naming file, key, value and what was expected.
SideFile read_side_file(const std::filesystem::path& path);

}  // namespace amble::morphology
