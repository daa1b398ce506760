#pragma once

#include <functional>
#include <string>

#include "amble/robot/spec.hpp"

namespace amble::robot {

/// Finds the first violation of a RobotSpec's invariants (indices out of range, joints out of control order,
/// numbers that are not finite, masses or moments that are not positive, a range without the start pose, …)
/// and passes a one-line description to `report`, which must throw.
void check_robot(const RobotSpec& robot, const std::function<void(const std::string& problem)>& report);

}  // namespace amble::robot
