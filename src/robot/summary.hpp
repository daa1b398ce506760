#pragma once

#include <string>

#include "amble/robot/spec.hpp"

namespace amble::robot {

/// The robot as tables of plain text.
std::string summary(const RobotSpec& robot);

}  // namespace amble::robot
