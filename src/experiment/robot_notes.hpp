#pragma once

#include <optional>
#include <string>
#include <vector>

#include "amble/robot/spec.hpp"

namespace amble::experiment {

/// What the batch engine's solver leaves undone of this robot, as a line; none if that engine cannot simulate
/// it.
std::optional<std::string> solver_line(const robot::RobotSpec& robot);

/// The line for the table [contact] of a robot file whose robot needs more sweeps than it has; else empty.
std::string sweeps_line(const robot::RobotSpec& robot);

/// "warnings:" and a line each; empty without any.
std::string doubts_text(const std::vector<std::string>& doubts);

/// What a robot does in a second in which its start pose is held, and what else is odd about it.
std::string start_text(const robot::RobotSpec& robot);

}  // namespace amble::experiment
