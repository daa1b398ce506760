#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/robot/spec.hpp"

namespace amble::cli {

/// `amble robot --init`: guesses a robot file from a model, writes it and a config into `folder` (empty: one
/// of the model's name here), loads the robot and says what was read, what is still to be given, and what to
/// do next. Throws UserError for a model that cannot be read and for files that are there already.
ExitCode init_robot(const std::filesystem::path& model, std::filesystem::path folder);

/// "warnings:" and a line each; empty without any.
std::string doubts_text(const std::vector<std::string>& doubts);
/// What a robot does in a second in which its start pose is held, and what else is odd about it.
std::string start_text(const robot::RobotSpec& robot);

}  // namespace amble::cli
