#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "amble/core/lanes.hpp"
#include "amble/morphology/pose.hpp"
#include "amble/morphology/robot_file.hpp"
#include "amble/physics/engine.hpp"

namespace amble::physics {

inline morphology::RobotSpec scene(const std::string& name) {
  return morphology::load_robot(std::string(AMBLE_SOURCE_DIR "/scenes/") + name + ".toml");
}

inline morphology::RobotSpec quadruped(const std::string& variant = "authors") {
  return morphology::load_robot(std::string(AMBLE_SOURCE_DIR "/robots/quadruped/") + variant + ".toml");
}

/// The same robot high above the ground.
inline morphology::RobotSpec lifted(morphology::RobotSpec robot, double by_m) {
  robot.bodies[0].position_m.z += by_m;
  return robot;
}

inline morphology::RobotSpec weightless(morphology::RobotSpec robot) {
  robot = lifted(std::move(robot), 100.0);
  robot.gravity_m_s2 = {};
  return robot;
}

/// An engine with its robot placed, and targets to steer it by.
struct Bench {
  morphology::RobotSpec robot;
  std::unique_ptr<Engine> engine;
  LaneArray targets;
  double timestep_s;

  Bench(std::string_view name, morphology::RobotSpec spec, double h = 0.01)
      : robot(std::move(spec)),
        engine(make_engine(name, robot, {.timestep_s = h})),
        targets(static_cast<int>(robot.joints.size()), 1),
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

/// Tests that every engine must pass.
class EachEngine : public testing::TestWithParam<std::string_view> {
 protected:
  static std::string_view engine_name() { return GetParam(); }
};

inline const auto every_engine = testing::ValuesIn(engine_names);

inline std::string engine_of(const testing::TestParamInfo<std::string_view>& info) {
  return std::string(info.param);
}

/// Forward kinematics: where all bodies are for a pose of the root and joint angles. Independent of any
/// engine.
inline std::vector<morphology::Pose> kinematics(const morphology::RobotSpec& robot, const RootPose& root,
                                                const std::vector<double>& angles_rad) {
  std::vector<morphology::Pose> poses{{root.position_m, root.rotation}};
  for (int b = 1; b < static_cast<int>(robot.bodies.size()); ++b) {
    const morphology::Body& body = robot.bodies[static_cast<std::size_t>(b)];
    morphology::Pose pose =
        poses[static_cast<std::size_t>(body.parent)] * morphology::Pose{body.position_m, body.rotation};
    for (const int j : robot.joints_of_body(b)) {
      const morphology::Joint& joint = robot.joints[static_cast<std::size_t>(j)];
      pose =
          pose *
          morphology::Pose{joint.anchor_m, axis_angle(joint.axis, angles_rad[static_cast<std::size_t>(j)])} *
          morphology::Pose{-joint.anchor_m, {}};
    }
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace amble::physics
