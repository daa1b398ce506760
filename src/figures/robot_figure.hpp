#pragma once

#include <string>

#include "amble/robot/spec.hpp"

namespace amble::figures {

/// The robot in its start pose, at one scale: from its right, from the front and from above, with the names
/// of its legs. Forward points to the right from its right and from above. An <svg> element (svg.hpp).
std::string robot_figure(const robot::RobotSpec& robot);

}  // namespace amble::figures
