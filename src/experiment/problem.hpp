#pragma once

#include <filesystem>

#include "amble/experiment/config.hpp"
#include "amble/experiment/problem/problem.hpp"
#include "amble/robot/spec.hpp"

namespace amble::morphology {
class ReadingNotes;
}

namespace amble::experiment {

/// The robot of a config, intact and on the plane: Problem::make() makes of it what walks. Throws UserError
/// as load_robot_file(); if its file is missing, with the place that names it.
robot::RobotSpec load_robot(const Config& config);
/// A robot file: the TOML side file of a model, or the robot.json of a run folder. `notes`, if given, gets
/// how the model's parts were handled. Throws UserError: the file cannot be read (ExitCode::io), says what
/// cannot be (bad_input), or is an altered or foreign robot.json (bad_file).
robot::RobotSpec load_robot_file(const std::filesystem::path& path,
                                 morphology::ReadingNotes* notes = nullptr);

}  // namespace amble::experiment
