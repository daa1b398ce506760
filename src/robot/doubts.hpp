#pragma once

#include <string>
#include <vector>

#include "amble/robot/spec.hpp"

namespace amble::robot {

/// The least and greatest ratio of a body's inertia to that of its shapes that is not doubted, and the
/// greatest density of shapes that are taken for all of a body.
constexpr double doubted_inertia_factor = 3.0, densest_kg_m3 = 8000.0;

/// Whether a body of that mass would only have moments of inertia of that sum if it were more than twice as
/// large as its whole robot, which reaches so far: templates of URDF have 100 kg m² for anything.
constexpr bool is_larger_than_robot(double moments_kg_m2, double mass_kg, double reach_m) {
  return reach_m > 0.0 && moments_kg_m2 > 8.0 * mass_kg * reach_m * reach_m;
}

/// What of a robot is allowed but hardly meant, a line each with what to look at; none: nothing.
/// - A body whose moments of inertia (their sum) are more than three times those of its shapes filled evenly
///   with its mass, or less than a third. Shapes that would be denser than steel, or whose centre is
///   farther from the body's centre of mass than their radius of gyration, are not all of it, and say
///   nothing.
/// - A joint whose largest torque does not hold the weight of the robot on half of its legs in the start pose
///   (the force is vertical, at the centre of the foot; the weight of the leg itself is not subtracted); if
///   all do, one that does not hold it once the foot is a quarter of its distance ahead or aside.
/// - Motors too strong for the robot, as torques in kg·cm are, and joints that spin a leg about itself
///   (leg_doubts.hpp).
/// - Stops more than two turns away, and most joints with stops less than 0.1 rad apart: degrees for radians,
///   or the other way round.
std::vector<std::string> doubts(const RobotSpec& robot);

/// Joints whose largest torque does not hold the weight on half of the legs in the start pose, with both
/// torques: "knee (0.1 of 0.4 N m)".
std::vector<std::string> weak_joints(const RobotSpec& robot);

/// The torque about each joint's axis, N m and signed, under the weight on half of the legs; 0 of joints that
/// are not between a foot and the root.
std::vector<double> bearing_torques_nm(const RobotSpec& robot);
/// The greatest that the same weight asks of each joint where the foot is aside by a quarter of its distance.
std::vector<double> stepping_torques_nm(const RobotSpec& robot);

}  // namespace amble::robot
