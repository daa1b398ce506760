#pragma once

#include <string>

#include "amble/morphology/robot_spec.hpp"

namespace amble::morphology {

/// What was read from a robot file, as tables to read on a terminal.
std::string summary(const RobotSpec& robot);

}  // namespace amble::morphology
