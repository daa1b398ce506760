#pragma once

#include <algorithm>
#include <vector>

#include "amble/robot/spec.hpp"

namespace amble::controllers {

/// A joint's range of targets, rad (robot::Joint::command_range); of zero width if it is not driven.
struct JointRange {
  double lower_rad = 0.0, upper_rad = 0.0;

  /// The target of a command: 0 is the lower end, 1 the upper.
  float at(double command) const { return static_cast<float>(lower_rad + (upper_rad - lower_rad) * command); }
};

/// The target of a joint that no controller drives: the start pose, or what is nearest to it in its range.
inline float held_target_rad(const robot::Joint& joint) {
  const robot::AngleRange command = joint.command_range();
  return static_cast<float>(std::clamp(0.0, command.lower_rad, command.upper_rad));
}

/// Joint by joint in control order.
inline std::vector<JointRange> joint_ranges(const robot::RobotSpec& robot) {
  std::vector<JointRange> ranges;
  for (const robot::Joint& joint : robot.joints) {
    const robot::AngleRange command = joint.command_range();
    ranges.push_back({command.lower_rad, command.upper_rad});
  }
  return ranges;
}

}  // namespace amble::controllers
