#pragma once

#include <string>

#include "amble/robot/spec.hpp"

namespace amble::robot {

/// What was read from a robot file, as tables to read on a terminal.
std::string summary(const RobotSpec& robot);

}  // namespace amble::robot
