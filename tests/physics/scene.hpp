#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "amble/core/lanes.hpp"
#include "amble/morphology/robot_file.hpp"
#include "amble/physics/engine.hpp"
#include "amble/robot/pose.hpp"

namespace amble::physics {

inline robot::RobotSpec scene(const std::string& name) {
  return morphology::load_robot(std::string(AMBLE_SOURCE_DIR "/scenes/") + name + ".toml");
}

inline robot::RobotSpec quadruped(const std::string& variant = "authors") {
  return morphology::load_robot(std::string(AMBLE_SOURCE_DIR "/robots/quadruped/") + variant + ".toml");
}

/// The same robot high above the ground.
inline robot::RobotSpec lifted(robot::RobotSpec robot, double by_m) {
  robot.bodies[0].position_m.z += by_m;
  return robot;
}

inline robot::RobotSpec weightless(robot::RobotSpec robot) {
  robot = lifted(std::move(robot), 100.0);
  robot.gravity_m_s2 = {};
  return robot;
}

/// With a first leg that no motor moves, between stops that it reaches.
inline robot::RobotSpec limping(robot::RobotSpec robot) {
  for (const int j : robot.legs[0].joints) {
    robot::Joint& joint = robot.joints[static_cast<std::size_t>(j)];
    joint.lower_rad = std::max(joint.lower_rad, -0.3);
    joint.upper_rad = std::min(joint.upper_rad, 0.2);
    joint.servo = {.mode = robot::ServoMode::torque, .max_torque_nm = 5.0};
  }
  return robot;
}

/// Makes a geom an uneven pyramid on four corners, about 0.1 m wide.
inline void become_pyramid(robot::Geom& geom) {
  geom.shape = robot::Shape::mesh;
  geom.vertices_m = {{0.0, 0.01, 0.06},
                     {0.05, 0.05, -0.03},
                     {-0.06, 0.05, -0.03},
                     {-0.05, -0.05, -0.03},
                     {0.05, -0.04, -0.03}};
  geom.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {1, 4, 3}, {1, 3, 2}};
  geom.size_m = {0.1, 0.0, 0.0};
}

/// An engine with its robot placed, and targets to steer it by.
struct Bench {
  robot::RobotSpec robot;
  std::unique_ptr<Engine> engine;
  LaneArray targets;
  double timestep_s;

  explicit Bench(robot::RobotSpec spec, double h = 0.01, bool torques = false)
      : Bench("ode", std::move(spec), h, torques) {}
  /// The robot stands in lane 0, alone.
  Bench(const std::string& name, robot::RobotSpec spec, double h = 0.01, bool torques = false)
      : robot(std::move(spec)),
        engine(make_engine(name, robot, {.timestep_s = h, .torques = torques})),
        targets(static_cast<int>(robot.joints.size()), engine->lanes()),
        timestep_s(h) {
    engine->place(0);
  }

  void steps(int count) {
    for (int i = 0; i < count; ++i) engine->step(targets);
  }
  double angle(int joint) const {
    return static_cast<double>(engine->sensors().joint_angle_rad.at(joint, 0));
  }
  bool touches(int leg) const { return engine->sensors().touch.at(leg, 0) == 1.0f; }
};

/// A claim about every engine.
class OnEachEngine : public testing::TestWithParam<const char*> {
 protected:
  bool single_precision() const { return std::string(GetParam()) == "batch"; }
  /// Joint angles and their speeds as coordinates keep the robot's momentum to first order in the time step.
  bool drifting() const { return std::string(GetParam()) == "mujoco"; }
};
#define ON_ENGINES(suite, ...)                                           \
  INSTANTIATE_TEST_SUITE_P(Physics, suite, testing::Values(__VA_ARGS__), \
                           [](const auto& engine) { return std::string(engine.param); })
#define ON_EACH_ENGINE(suite) ON_ENGINES(suite, "ode", "batch", "mujoco")
/// Those that step one robot at a time, in double precision.
#define ON_EACH_REFEREE(suite) ON_ENGINES(suite, "ode", "mujoco")

/// Forward kinematics: where all bodies are for a pose of the root and joint angles. Independent of any
/// engine.
inline std::vector<robot::Pose> kinematics(const robot::RobotSpec& robot, const RootPose& root,
                                           const std::vector<double>& angles_rad) {
  std::vector<robot::Pose> poses{{root.position_m, root.rotation}};
  for (int b = 1; b < static_cast<int>(robot.bodies.size()); ++b) {
    const robot::Body& body = robot.bodies[static_cast<std::size_t>(b)];
    robot::Pose pose =
        poses[static_cast<std::size_t>(body.parent)] * robot::Pose{body.position_m, body.rotation};
    for (const int j : robot.joints_of_body(b)) {
      const robot::Joint& joint = robot.joints[static_cast<std::size_t>(j)];
      pose = pose *
             robot::Pose{joint.anchor_m, axis_angle(joint.axis, angles_rad[static_cast<std::size_t>(j)])} *
             robot::Pose{-joint.anchor_m, {}};
    }
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace amble::physics
