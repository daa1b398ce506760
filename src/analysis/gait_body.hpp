#pragma once

#include <optional>
#include <string>
#include <vector>

#include "amble/core/math.hpp"
#include "amble/robot/spec.hpp"

namespace amble::analysis {

/// Which leg is which, indices into the robot's legs.
struct QuadrupedLegs {
  int fore_left = 0, fore_right = 1, hind_left = 2, hind_right = 3;
};

/// What gait analysis needs to know of a robot.
struct GaitBody {
  std::string robot;
  std::vector<std::string> legs;
  std::vector<std::string> joints;
  double mass_kg = 0.0;
  double gravity_m_s2 = 9.8;  ///< its magnitude
  /// Height of the hips over the ground in the start pose, mean over the legs (Alexander 1984 measures legs
  /// so); 0 if no leg has a joint.
  double leg_length_m = 0.0;
  Vec3 com_start_m;
  /// By where the feet stand in the start pose; nothing unless there are four, two behind two, with a left
  /// and a right one each.
  std::optional<QuadrupedLegs> quadruped;
};

GaitBody gait_body(const robot::RobotSpec& robot);

}  // namespace amble::analysis
