#pragma once

#include <optional>
#include <string>
#include <vector>

#include "amble/core/math.hpp"
#include "amble/robot/legs.hpp"
#include "amble/robot/spec.hpp"

namespace amble::gait {

/// Which leg is which, indices into the robot's legs.
struct QuadrupedLegs {
  int fore_left = 0, fore_right = 1, hind_left = 2, hind_right = 3;
};

/// What gait measurement needs to know of a robot.
struct Body {
  std::string robot;
  std::vector<std::string> legs;
  std::vector<std::string> joints;
  double mass_kg = 0.0;
  double gravity_m_s2 = 9.8;  ///< its magnitude
  /// Height of the hips above the ground in the start pose, mean over the legs (the leg length of Alexander
  /// 1984); 0 if no leg has a joint.
  double leg_length_m = 0.0;
  Vec3 com_start_m;
  std::vector<float> angle_start_rad;  ///< by joint, before the first frame; empty: 0, the start pose
  /// From the positions of the feet in the start pose; none unless there are four, two fore and two hind,
  /// each pair with a left and a right one.
  std::optional<QuadrupedLegs> quadruped;
  /// For bodies with two or six legs: left and right ones beside each other, from front to back, by the feet
  /// in the start pose; empty where that cannot be told.
  std::vector<robot::LegPair> pairs;
};

Body body_of(const robot::RobotSpec& robot);

}  // namespace amble::gait
