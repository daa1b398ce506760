#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include "tests/physics/scene.hpp"

/// ODE itself loses working memory when a fault interrupts a step; see ode::Threading::replace().
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libode.so";
}

namespace amble::physics {
namespace {

void poison(Bench& bench) {
  bench.targets.at(3, 0) = std::numeric_limits<float>::quiet_NaN();
}

/// Forces that overflow inside dWorldStep, where ODE's own checks would end the process.
robot::RobotSpec crushed() {
  robot::RobotSpec robot = quadruped();
  robot.gravity_m_s2.z = -1e308;
  return robot;
}

class Divergence : public OnEachEngine {};
ON_EACH_ENGINE(Divergence);

TEST_P(Divergence, ATargetThatIsNotANumberEndsTheTrialAndNotTheProcess) {
  Bench bench(GetParam(), quadruped());
  bench.steps(20);
  const std::uint64_t healthy = bench.engine->state_hash(0);
  ASSERT_TRUE(bench.engine->healthy(0));
  poison(bench);
  bench.steps(1);
  EXPECT_FALSE(bench.engine->healthy(0));
  bench.targets.set_lane(0, 0.0f);
  bench.steps(5);  // goes nowhere
  EXPECT_FALSE(bench.engine->healthy(0));

  bench.engine->place(0);
  EXPECT_TRUE(bench.engine->healthy(0));
  bench.steps(20);
  EXPECT_EQ(bench.engine->state_hash(0), healthy);
}

TEST_P(Divergence, ForcesBeyondAllNumbersEndTheTrialAndNotTheProcess) {
  Bench bench(GetParam(), crushed());
  const std::uint64_t start = bench.engine->state_hash(0);
  for (int i = 0; i < 100; ++i) {
    bench.steps(3);
    ASSERT_FALSE(bench.engine->healthy(0)) << i;
    bench.engine->place(0);
    ASSERT_TRUE(bench.engine->healthy(0)) << i;
    ASSERT_EQ(bench.engine->state_hash(0), start) << i;
  }
}

TEST_P(Divergence, OneEnginesFaultLeavesTheOthersAlone) {
  Bench undisturbed(GetParam(), quadruped());
  undisturbed.steps(40);
  std::vector<int> faults(2, 0);
  Bench bench(GetParam(), quadruped());
  {
    std::vector<std::jthread> threads;
    for (int& count : faults) {
      threads.emplace_back([&count] {
        Bench own(GetParam(), crushed());
        for (int i = 0; i < 20; ++i) {
          own.steps(2);
          count += own.engine->healthy(0) ? 0 : 1;
          own.engine->place(0);
        }
      });
    }
    bench.steps(40);
  }
  EXPECT_EQ(faults, (std::vector<int>{20, 20}));
  EXPECT_EQ(bench.engine->state_hash(0), undisturbed.engine->state_hash(0));
}

TEST_P(Divergence, AbsurdSpeedIsNotHealthy) {
  robot::RobotSpec robot = lifted(scene("box"), 1e6);
  robot.gravity_m_s2 = {0.0, 0.0, -9.8e3};
  Bench bench(GetParam(), robot);
  bench.steps(10);  // 980 m/s
  EXPECT_TRUE(bench.engine->healthy(0));
  bench.steps(1);  // 1078 m/s
  EXPECT_FALSE(bench.engine->healthy(0));
}

TEST_P(Divergence, AnAbsurdSpeedOfAJointIsNotHealthyThoughTheRootHardlyMoves) {
  // A motor without limits turns the arm at gain × (target − angle) in one step; the stand has 10 t.
  for (const double speed_rad_s : {900.0, -900.0, 2000.0, -2000.0}) {
    robot::RobotSpec robot = weightless(scene("pendulum"));
    robot.joints[0].servo = {
        .mode = robot::ServoMode::velocity, .gain_per_s = std::abs(speed_rad_s), .max_torque_nm = 1e9};
    Bench bench(GetParam(), robot);
    bench.targets.at(0, 0) = speed_rad_s > 0.0 ? 1.0f : -1.0f;
    const Vec3 root_before_m = bench.engine->root_com_m(0);
    bench.steps(1);
    EXPECT_EQ(bench.engine->healthy(0), std::abs(speed_rad_s) < absurd_speed) << speed_rad_s;
    EXPECT_LT(norm(bench.engine->root_com_m(0) - root_before_m), 0.01) << speed_rad_s;
  }
}

TEST_P(Divergence, AnAbsurdSpeedOfAnyOneJointIsNotHealthy) {
  // All motors are rigid; the torso has 10 t, so that it stays.
  robot::RobotSpec robot = weightless(quadruped());
  robot.bodies[0].mass_kg = 1e4;
  robot.bodies[0].inertia_kg_m2 = {1e4, 1e4, 1e4};
  for (auto& joint : robot.joints) {
    joint.lower_rad = -3.0;
    joint.upper_rad = 3.0;
    joint.servo = {.mode = robot::ServoMode::velocity, .gain_per_s = 1.0, .max_torque_nm = 1e9};
  }
  for (const double speed_rad_s : {900.0, 2000.0})
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      robot::RobotSpec fast = robot;
      fast.joints[j].servo.gain_per_s = speed_rad_s;
      Bench bench(GetParam(), fast);
      bench.targets.at(static_cast<int>(j), 0) = 1.0f;
      bench.steps(1);
      EXPECT_EQ(bench.engine->healthy(0), speed_rad_s < absurd_speed) << j << ' ' << speed_rad_s;
    }
}

/// A light root, a wheel on it and a heavy wheel on that one, all balanced on one axle. Their motors turn
/// them against each other at this speed, so the root turns at twice that speed, and no centre of mass moves.
robot::RobotSpec wheels(double speed_rad_s) {
  robot::RobotSpec robot = weightless(scene("pendulum"));
  robot::Joint& joint = robot.joints[0];
  joint.anchor_m = {};
  joint.servo = {.mode = robot::ServoMode::velocity, .gain_per_s = speed_rad_s, .max_torque_nm = 1e9};
  robot.bodies[1].position_m = {};
  for (robot::Body& body : robot.bodies) {
    body.com_m = {};
    body.mass_kg = 1.0;
    body.inertia_kg_m2 = {0.01, 0.01, 0.01};
    body.inertia_rotation = {};
  }
  robot.bodies.push_back(robot.bodies[1]);
  robot.bodies[2].name = "heavy wheel";
  robot.bodies[2].parent = 1;
  robot.bodies[2].mass_kg = 1e3;
  robot.bodies[2].inertia_kg_m2 = {1e3, 1e3, 1e3};
  robot::Joint second = joint;
  second.name = "second";
  second.body = 2;
  second.command = robot::AngleRange{joint.lower_rad, joint.upper_rad};
  robot.joints.push_back(second);
  return robot;
}

TEST_P(Divergence, AnAbsurdTurningOfTheRootIsNotHealthyThoughNothingElseIsAbsurd) {
  for (const double speed_rad_s : {400.0, 900.0}) {
    Bench bench(GetParam(), wheels(speed_rad_s));
    const Vec3 root_before_m = bench.engine->root_com_m(0);
    bench.targets.set_lane(0, 1.0f);
    bench.steps(1);
    EXPECT_EQ(bench.engine->healthy(0), 2.0 * speed_rad_s < absurd_speed) << speed_rad_s;
    EXPECT_LT(norm(bench.engine->root_com_m(0) - root_before_m), 0.01) << speed_rad_s;
  }
}

}  // namespace
}  // namespace amble::physics
