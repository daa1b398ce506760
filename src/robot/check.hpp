#pragma once

#include <functional>
#include <string>

#include "amble/robot/spec.hpp"

namespace amble::robot {

/// Finds the first violation of a RobotSpec's invariants (indices out of range, joints out of control order,
/// numbers that are not finite, masses or moments that are not positive, a range without the start pose, …)
/// and passes a one-line description to `report`, which must throw.
void check_robot(const RobotSpec& robot, const std::function<void(const std::string& problem)>& report);

/// What is wrong with a gravity for robots that are to walk on the plane z = 0, and what to do about it;
/// empty if it points down, at most 30 degrees off, as on a slope.
std::string gravity_fault(Vec3 gravity_m_s2);

}  // namespace amble::robot
