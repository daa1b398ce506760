#pragma once

#include <array>
#include <string>
#include <utility>

#include "amble/robot/spec.hpp"

namespace amble::controllers {

/// As much of the quadruped as controllers know: legs, joint types, and the ranges of docs/CONVENTIONS.md.
inline robot::RobotSpec quadruped() {
  robot::RobotSpec robot;
  robot.joint_types = {"knee", "hip_fb", "hip_io"};
  for (const std::string leg : {"FL", "FR", "BL", "BR"}) {
    const std::pair<double, double> knee = leg[0] == 'F' ? std::pair{-0.8, 0.0} : std::pair{0.0, 0.8};
    const std::array<std::pair<double, double>, 3> ranges{knee, {-0.8, 0.8}, {0.0, 0.4}};
    robot::Leg& spec = robot.legs.emplace_back();
    spec.foot_geoms = {0};
    spec.name = leg;
    for (std::size_t type = 0; type < ranges.size(); ++type) {
      spec.joints.push_back(static_cast<int>(robot.joints.size()));
      robot::Joint& joint = robot.joints.emplace_back();
      joint.name = leg + "_" + robot.joint_types[type];
      joint.lower_rad = ranges[type].first;
      joint.upper_rad = ranges[type].second;
    }
  }
  return robot;
}

}  // namespace amble::controllers
