#pragma once

#include <filesystem>

#include "amble/morphology/model_file.hpp"
#include "amble/morphology/model_parts.hpp"
#include "amble/morphology/reading_notes.hpp"
#include "amble/morphology/side_file.hpp"
#include "amble/robot/spec.hpp"

namespace amble::morphology {

/// Reads a robot from its TOML file, e.g. robots/quadruped/authors.toml, and the MJCF or URDF model it names,
/// compiled by MuJoCo. robots/README.md describes both. Throws UserError with one line that names file and
/// part, for everything that is missing, unknown or not supported: see SideFile, extract_parts() and
/// check_robot(); besides, joints of the model that the file does not name and the reverse, joints without
/// stops and range of command, and a foot that starts below the ground. `notes`, if given, gets how the
/// model's parts were handled.
robot::RobotSpec load_robot(const std::filesystem::path& path, ReadingNotes* notes = nullptr);
/// The same of what was read and compiled before; `what` is what messages call the robot file, `before` as of
/// extract_parts().
robot::RobotSpec make_robot(const SideFile& side, const ModelFile& model, const std::string& what,
                            ReadingNotes* notes = nullptr, const ModelParts* before = nullptr);

}  // namespace amble::morphology
