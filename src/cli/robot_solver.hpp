#pragma once

#include <optional>
#include <string>

#include "amble/robot/spec.hpp"

namespace amble::cli {

/// What the batch engine's solver leaves undone of this robot, as a line; none if that engine cannot simulate
/// it.
std::optional<std::string> solver_line(const robot::RobotSpec& robot);

/// The line for the table [contact] of a robot file whose robot needs more sweeps than it has; else empty.
std::string sweeps_line(const robot::RobotSpec& robot);

}  // namespace amble::cli
