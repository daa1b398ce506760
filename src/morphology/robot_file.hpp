#pragma once

#include <filesystem>

#include "amble/robot/spec.hpp"

namespace amble::morphology {

/// Reads a robot from its TOML file, e.g. robots/quadruped/authors.toml, and the MJCF or URDF model it names,
/// compiled by MuJoCo. robots/README.md describes both. Throws UserError with one line that names file and
/// part, for everything that is missing, unknown or not supported: see SideFile, extract_parts() and
/// check_robot(); besides, a joint of the model that no leg names and the reverse, and a foot that starts
/// below the ground.
robot::RobotSpec load_robot(const std::filesystem::path& path);

}  // namespace amble::morphology
