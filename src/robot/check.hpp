#pragma once

#include <functional>
#include <string>

#include "amble/robot/spec.hpp"

namespace amble::robot {

/// Looks for the first thing in a RobotSpec that breaks its promises (indices out of range, joints out of
/// control order, numbers that are not finite, masses or moments that are not positive, a range without the
/// start pose, …) and hands a line about it to `complain`, which must throw.
void check_robot(const RobotSpec& robot, const std::function<void(const std::string& problem)>& complain);

}  // namespace amble::robot
