#pragma once

#include <string>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/robot/spec.hpp"

namespace amble::tests {

/// A robot with a left and a right leg in each row, from front to back, that engines can simulate. Each leg
/// has an upper and a lower part of 0.25 m and the joints knee, hip_fb and hip_io, in control order; legs are
/// L1, R1, L2, …
inline robot::RobotSpec legged_robot(int rows) {
  using namespace robot;
  RobotSpec robot;
  robot.name = "legged";
  robot.joint_types = {"knee", "hip_fb", "hip_io"};
  robot.contact = {.friction = 1.0, .erp = 0.2, .cfm_s_per_kg = 1e-5};
  robot.fall_height_m = 0.2;
  const double length_m = 0.4 * rows;
  robot.bodies.push_back({"torso", -1, {0, 0, 0.55}, {}, 2.0, {}, {0.1, 0.1, 0.1}, {}});
  robot.geoms.push_back({"torso", 0, true, Shape::box, {0.5 * length_m, 0.15, 0.05}, {}, {}});
  for (int leg = 0; leg < 2 * rows; ++leg) {
    const int row = leg / 2;
    const double side = leg % 2 == 0 ? 1.0 : -1.0, x_m = 0.5 * length_m - 0.2 - 0.4 * row;
    const std::string name = (leg % 2 == 0 ? "L" : "R") + std::to_string(row + 1);
    const int upper = static_cast<int>(robot.bodies.size()), lower = upper + 1;
    const Vec3 inertia_kg_m2{0.003, 0.003, 0.003};
    robot.bodies.push_back(
        {name + "_upper", 0, {x_m, 0.15 * side, 0}, {}, 0.3, {0, 0, -0.12}, inertia_kg_m2, {}});
    robot.bodies.push_back(
        {name + "_lower", upper, {0, 0, -0.25}, {}, 0.3, {0, 0, -0.12}, inertia_kg_m2, {}});
    const int foot = static_cast<int>(robot.geoms.size());
    robot.geoms.push_back({name + "_foot", lower, true, Shape::sphere, {0.05, 0, 0}, {0, 0, -0.25}, {}});
    const int knee = static_cast<int>(robot.joints.size());
    const auto add = [&](const char* type, int body, int chain_index, Vec3 axis, double lower_rad,
                         double upper_rad) {
      Joint joint;
      joint.name = name + "_" + type;
      joint.body = body;
      joint.chain_index = chain_index;
      joint.axis = axis;
      joint.lower_rad = lower_rad;
      joint.upper_rad = upper_rad;
      robot.joints.push_back(joint);
    };
    add("knee", lower, 0, {0, 1, 0}, 0.0, 0.8);
    add("hip_fb", upper, 1, {0, 1, 0}, -0.8, 0.8);
    add("hip_io", upper, 0, {side, 0, 0}, 0.0, 0.4);
    robot.legs.push_back({name, {foot}, {knee, knee + 1, knee + 2}});
  }
  return robot;
}

/// The robot without one leg's joint of one type: the joint is there, but held.
inline robot::RobotSpec with_held_joint(robot::RobotSpec robot, int leg, int type) {
  robot.joints[to_index(robot.legs[to_index(leg)].joints[to_index(type)])].command = robot::AngleRange{};
  return robot;
}

/// The robot whose last leg has no motor at its hip_io, but a spring.
inline robot::RobotSpec with_passive_joint(robot::RobotSpec robot) {
  robot.legs.back().joints[2] = -1;
  robot::Joint& joint = robot.joints.back();
  joint.servo = {.mode = robot::ServoMode::none, .gain_per_s = 0.0, .max_torque_nm = 0.0};
  joint.command = robot::AngleRange{};
  joint.stiffness_nm_per_rad = 20.0;
  joint.rest_rad = 0.1;
  return robot;
}

/// The robot without one leg's hip_io: the leg has no joint of that type.
inline robot::RobotSpec without_hip_io(robot::RobotSpec robot, int leg) {
  const int gone = robot.legs[to_index(leg)].joints[2];
  robot.joints[to_index(gone - 1)].chain_index = 0;
  robot.joints.erase(robot.joints.begin() + gone);
  for (robot::Leg& other : robot.legs)
    for (int& joint : other.joints) joint = joint == gone ? -1 : joint > gone ? joint - 1 : joint;
  return robot;
}

}  // namespace amble::tests
