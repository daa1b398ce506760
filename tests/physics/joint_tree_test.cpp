#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "amble/core/index.hpp"
#include "amble/core/random.hpp"
#include "tests/physics/scene.hpp"

namespace amble::physics {
namespace {

class JointTree : public OnEachEngine {};
ON_EACH_ENGINE(JointTree);

/// The quadruped with more joints than legs have: below its first upper leg hang two lower legs, and on the
/// second of these a tail that branches again.
robot::RobotSpec branching() {
  robot::RobotSpec robot = weightless(quadruped());
  robot.contact.cfm_s_per_kg = 1e-9;
  const auto add = [&](int like, int parent) {
    robot.bodies.push_back(robot.bodies[to_index(like)]);
    robot.bodies.back().parent = parent;
    robot.joints.push_back(robot.joints[0]);
    robot.joints.back().body = static_cast<int>(robot.bodies.size()) - 1;
    robot.joints.back().command = robot::AngleRange{};
    return robot.joints.back().body;
  };
  const int second = add(2, 1);
  robot.joints.back().axis = {0.0, 0.6, 0.8};
  add(2, second);
  add(2, second);
  robot.joints.back().axis = {1.0, 0.0, 0.0};
  return robot;
}

/// Joint angles after 0.4 s of motors that pull with all their strength.
std::vector<double> angles_in_flight(const char* engine, const robot::RobotSpec& robot, double h) {
  Bench bench(engine, robot, h);
  Stream stream(3, Purpose::test);
  std::vector<double> angles;
  for (int n = 0; n < static_cast<int>(std::lround(0.4 / h)); ++n) {
    if (n % static_cast<int>(std::lround(0.1 / h)) == 0)
      for (int j = 0; j < bench.targets.rows(); ++j)
        bench.targets.at(j, 0) = static_cast<float>(stream.uniform(-0.6, 0.6));
    bench.steps(1);
  }
  for (int j = 0; j < bench.targets.rows(); ++j) angles.push_back(bench.angle(j));
  return angles;
}

void expect_alike(const char* engine, const robot::RobotSpec& robot, double tolerance_rad) {
  const double h = 0.0005;
  const std::vector<double> expected = angles_in_flight("mujoco", robot, h);
  const std::vector<double> angles = angles_in_flight(engine, robot, h);
  double largest = 0.0;
  for (std::size_t j = 0; j < angles.size(); ++j) {
    EXPECT_NEAR(angles[j], expected[j], tolerance_rad) << robot.joints[j].name << " " << j;
    largest = std::max(largest, std::abs(expected[j]));
  }
  EXPECT_GT(largest, 0.3);
}

TEST_P(JointTree, ThatBranchesMovesAlikeInAllEngines) {
  expect_alike(GetParam(), branching(), 4e-3);
}

TEST_P(JointTree, OfHeldAndHeavyPassiveJointsMovesAlikeInAllEngines) {
  robot::RobotSpec robot = branching();
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    robot.joints[j].armature_kg_m2 = j % 2 == 0 ? 0.01 : 0.0;
    robot.joints[j].damping_nm_s_per_rad = j % 3 == 0 ? 0.1 : 0.0;
    robot.joints[j].friction_loss_nm = j % 5 == 0 ? 0.2 : 0.0;
    if (j % 4 == 1)
      robot.joints[j].servo = {.mode = robot::ServoMode::torque,
                               .max_torque_nm = 5.0,
                               .kp_nm_per_rad = 30.0,
                               .kd_nm_s_per_rad = 0.3};
  }
  expect_alike(GetParam(), robot, 4e-3);
}

TEST_P(JointTree, OfLegsWithThreeJointsAndDryFrictionMovesAlikeInAllEngines) {
  robot::RobotSpec robot = weightless(quadruped());
  robot.contact.cfm_s_per_kg = 1e-9;
  for (std::size_t j = 0; j < robot.joints.size(); ++j)
    robot.joints[j].friction_loss_nm = 0.5 * robot.joints[j].servo.max_torque_nm;
  expect_alike(GetParam(), robot, 4e-3);
}

TEST_P(JointTree, OfLegsWithThreeJointsOfWhichSomeHaveDryFrictionMovesAlikeInAllEngines) {
  robot::RobotSpec robot = weightless(quadruped());
  robot.contact.cfm_s_per_kg = 1e-9;
  for (std::size_t j = 0; j < robot.joints.size(); ++j)
    if (j % 5 < 2) robot.joints[j].friction_loss_nm = 0.5 * robot.joints[j].servo.max_torque_nm;
  expect_alike(GetParam(), robot, 4e-3);
}

/// Three hinges on one body that neither cross nor are at right angles.
robot::RobotSpec shoulder() {
  robot::RobotSpec robot = weightless(quadruped());
  robot.contact.cfm_s_per_kg = 1e-9;
  robot.joints[1].axis = {0.6, 0.8, 0.0};
  robot.joints[4].anchor_m.z -= 0.05;
  robot.joints.push_back(robot.joints[0]);
  robot.joints.back().body = robot.joints[1].body;
  robot.joints.back().chain_index = 2;
  robot.joints.back().axis = {0.0, 0.6, 0.8};
  robot.joints.back().anchor_m = {0.02, 0.01, 0.0};
  robot.joints.back().command = robot::AngleRange{};
  return robot;
}

TEST_P(JointTree, OfThreeSkewHingesOnABodyMovesAlikeInAllEngines) {
  // ODE has bodies of a thousandth of the mass between them.
  expect_alike(GetParam(), shoulder(), 1e-2);
}

TEST_P(JointTree, OfSkewHingesStartsInTheGivenPose) {
  const robot::RobotSpec robot = shoulder();
  Bench bench(GetParam(), robot);
  StartPose pose{.root = {robot.bodies[0].position_m, axis_angle({0.0, 0.6, 0.8}, 0.3)},
                 .joint_angle_rad = {}};
  for (std::size_t j = 0; j < robot.joints.size(); ++j)
    pose.joint_angle_rad.push_back(robot.joints[j].upper_rad > 0.0 ? 0.2 : -0.1);
  bench.engine->place_at(0, pose);
  for (std::size_t j = 0; j < robot.joints.size(); ++j)
    EXPECT_NEAR(bench.angle(static_cast<int>(j)), pose.joint_angle_rad[j], 1e-6) << j;
}

class ManyTurns : public OnEachEngine {};
ON_EACH_ENGINE(ManyTurns);

TEST_P(ManyTurns, AJointWithoutStopsTurnsOnAndOn) {
  robot::RobotSpec robot = weightless(scene("pendulum"));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  robot.joints[0].lower_rad = -infinity;
  robot.joints[0].upper_rad = infinity;
  robot.joints[0].command = robot::AngleRange{-20.0, 20.0};
  robot.joints[0].servo.max_torque_nm = 1e3;
  for (const float target : {-14.0f, 14.0f}) {
    Bench bench(GetParam(), robot);
    bench.targets.at(0, 0) = target;
    bench.steps(300);
    EXPECT_NEAR(bench.angle(0), static_cast<double>(target), 1e-3);
  }
}

TEST_P(ManyTurns, AStopBeyondHalfATurnHolds) {
  for (const double sign : {-1.0, 1.0})
    for (const double stop : {3.5, 7.0}) {
      robot::RobotSpec robot = weightless(scene("pendulum"));
      (sign < 0.0 ? robot.joints[0].lower_rad : robot.joints[0].upper_rad) = sign * stop;
      robot.joints[0].command = robot::AngleRange{-3.0, 3.0};
      robot.joints[0].servo.max_torque_nm = 3.0;
      // The servo aims at the stop with a speed that carries the arm into it.
      robot.joints[0].servo.gain_per_s = 4.0;
      Bench bench(GetParam(), robot);
      bench.targets.at(0, 0) = static_cast<float>(sign * 10.0);
      double farthest = 0.0;
      for (int n = 0; n < 600; ++n) {
        bench.steps(1);
        farthest = std::max(farthest, sign * bench.angle(0));
      }
      EXPECT_NEAR(farthest, stop, 0.1);
      EXPECT_NEAR(sign * bench.angle(0), stop, 1e-2);
      EXPECT_TRUE(bench.engine->healthy(0));
    }
}

TEST_P(ManyTurns, AJointWithOneStopBeyondHalfATurnPassesTheHalfTurnAtAnEvenSpeed) {
  for (const double sign : {-1.0, 1.0}) {
    robot::RobotSpec robot = weightless(scene("pendulum"));
    robot::Joint& joint = robot.joints[0];
    joint.lower_rad = sign < 0.0 ? -7.0 : -0.8;
    joint.upper_rad = sign < 0.0 ? 0.8 : 7.0;
    joint.command = robot::AngleRange{-0.8, 0.8};
    joint.servo = {.mode = robot::ServoMode::velocity, .gain_per_s = 1.0, .max_torque_nm = 1e3};
    Bench bench(GetParam(), robot);
    // A target that stays ahead of the angle asks for 2 rad/s all the time.
    for (int n = 0; sign * bench.angle(0) < 4.5; ++n) {
      ASSERT_LT(n, 300) << "stuck at " << bench.angle(0);
      bench.targets.at(0, 0) = static_cast<float>(bench.angle(0) + sign * 2.0);
      const double before = bench.angle(0);
      bench.steps(1);
      if (n > 0) {
        EXPECT_NEAR(sign * (bench.angle(0) - before), 0.02, 1e-3) << bench.angle(0);
      }
    }
  }
}

TEST_P(ManyTurns, AStopBeyondHalfATurnHoldsOnEitherOfTwoHingesThatCross) {
  // The other stop is within half a turn.
  for (const int j : {1, 2}) {
    robot::RobotSpec robot = weightless(quadruped());
    robot::Joint& joint = robot.joints[to_index(j)];
    joint.lower_rad = -4.5;
    joint.upper_rad = 0.8;
    joint.command = robot::AngleRange{-3.0, 0.8};
    joint.servo = {.mode = robot::ServoMode::velocity, .gain_per_s = 4.0, .max_torque_nm = 3.0};
    Bench bench(GetParam(), robot);
    bench.targets.at(j, 0) = -10.0f;
    double farthest = 0.0;
    for (int n = 0; n < 800; ++n) {
      bench.steps(1);
      farthest = std::min(farthest, bench.angle(j));
    }
    EXPECT_NEAR(farthest, -4.5, 0.1) << j;
    EXPECT_NEAR(bench.angle(j), -4.5, 1e-2) << j;
    EXPECT_TRUE(bench.engine->healthy(0)) << j;
  }
}

}  // namespace
}  // namespace amble::physics
