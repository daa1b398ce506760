#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "amble/core/random.hpp"
#include "tests/physics/scene.hpp"

namespace amble::physics {
namespace {

class Torques : public OnEachEngine {};
ON_EACH_ENGINE(Torques);

double torque(const Bench& bench, int joint) {
  return static_cast<double>(bench.engine->motor_torque_nm()->at(joint, 0));
}

TEST_P(Torques, AreReportedOnlyOnRequest) {
  EXPECT_EQ(make_engine(GetParam(), quadruped(), {})->motor_torque_nm(), nullptr);
  EXPECT_NE(make_engine(GetParam(), quadruped(), {.torques = true})->motor_torque_nm(), nullptr);
}

TEST_P(Torques, AreZeroFromThePlacingOfARobotToItsFirstStep) {
  Bench bench(GetParam(), quadruped(), 0.01, true);
  for (int round = 0; round < 2; ++round) {
    for (int j = 0; j < 12; ++j) {
      EXPECT_EQ(torque(bench, j), 0.0) << "round " << round;
      bench.targets.at(j, 0) = 0.5f;
    }
    bench.steps(3);
    EXPECT_NE(torque(bench, 0), 0.0);
    bench.engine->place(0);
  }
}

TEST_P(Torques, ChangeNoBitOfTheMotion) {
  Bench plain(GetParam(), quadruped()), told(GetParam(), quadruped(), 0.01, true);
  Stream stream(3, Purpose::test);
  for (int n = 0; n < 600; ++n) {
    if (n % 20 == 0)
      for (int j = 0; j < 12; ++j)
        plain.targets.at(j, 0) = told.targets.at(j, 0) = static_cast<float>(stream.uniform(-1.0, 1.0));
    plain.steps(1);
    told.steps(1);
    ASSERT_EQ(plain.engine->state_hash(0), told.engine->state_hash(0)) << n;
  }
}

TEST_P(Torques, HoldAPendulumAgainstGravity) {
  // 1 kg at 0.5 m from the hinge, at rest 0.2 + 0.5 rad off the vertical: m g l sin(0.7). About +y a positive
  // angle swings the bob to −x, so the motor holds it there with a positive torque.
  robot::RobotSpec robot = scene("pendulum");
  robot.joints[0].servo = {.mode = robot::ServoMode::velocity, .gain_per_s = 9.0, .max_torque_nm = 50.0};
  Bench bench(GetParam(), robot, 0.01, true);
  bench.targets.at(0, 0) = 0.5f;
  bench.steps(500);
  EXPECT_NEAR(torque(bench, 0), 1.0 * 9.8 * 0.5 * std::sin(0.2 + bench.angle(0)), 1e-3);
  EXPECT_NEAR(bench.angle(0), 0.5, 1e-3);
}

TEST_P(Torques, LiftingAPendulumCostsItsPotentialEnergy) {
  // From rest 0.2 rad off the vertical to rest at 1.2 rad: m g l (cos 0.2 − cos 1.2).
  robot::RobotSpec robot = scene("pendulum");
  robot.joints[0].servo = {.mode = robot::ServoMode::velocity, .gain_per_s = 2.0, .max_torque_nm = 50.0};
  Bench bench(GetParam(), robot, 0.001, true);
  bench.targets.at(0, 0) = 1.0f;
  // Over a step a torque does work at the mean of the speeds before and after it; the angle moves at the
  // speed after it.
  double work_j = 0.0, before_rad = bench.angle(0), turned_before_rad = 0.0;
  for (int n = 0; n < 5000; ++n) {
    bench.steps(1);
    const double turned_rad = bench.angle(0) - before_rad;
    work_j += torque(bench, 0) * 0.5 * (turned_rad + turned_before_rad);
    before_rad = bench.angle(0);
    turned_before_rad = turned_rad;
  }
  const double expected = 1.0 * 9.8 * 0.5 * (std::cos(0.2) - std::cos(1.2));
  EXPECT_NEAR(work_j, expected, 0.002 * expected);
}

TEST_P(Torques, ReachTheLimitOnEveryAxisOfAQuadrupedFarFromItsTargets) {
  // The legs are light and the gain is high: in the first steps all twelve motors give their 0.2 N m,
  // whatever the bearings carry. Also at stops, where ODE books the motor apart from the stop.
  robot::RobotSpec robot = weightless(quadruped());
  for (auto& joint : robot.joints) joint.servo = {.gain_per_s = 90.0, .max_torque_nm = 0.2};
  Bench bench(GetParam(), robot, 0.001, true);
  for (int j = 0; j < 12; ++j)
    bench.targets.at(j, 0) =
        static_cast<float>(bench.robot.joints[static_cast<std::size_t>(j)].lower_rad < 0.0 ? -0.8 : 0.8);
  for (int n = 0; n < 20; ++n) {
    bench.steps(1);
    for (int j = 0; j < 12; ++j)
      ASSERT_NEAR(torque(bench, j), bench.targets.at(j, 0) < 0.0f ? -0.2 : 0.2, 1e-6) << n << " " << j;
  }
}

TEST_P(Torques, AreTheMotorsOwnWhateverDryFrictionActsBesides) {
  // Far from their targets all motors give their limits, no two alike; the friction of each joint is less.
  robot::RobotSpec robot = weightless(quadruped());
  for (std::size_t j = 0; j < 12; ++j) {
    robot.joints[j].servo = {.gain_per_s = 90.0, .max_torque_nm = 0.2 + 0.01 * static_cast<double>(j)};
    robot.joints[j].friction_loss_nm = 0.05;
  }
  const auto direction = [&](int j) {
    return robot.joints[static_cast<std::size_t>(j)].lower_rad < 0.0 ? -1.0 : 1.0;
  };
  Bench bench(GetParam(), robot, 0.001, true);
  for (int j = 0; j < 12; ++j) bench.targets.at(j, 0) = static_cast<float>(0.8 * direction(j));
  for (int n = 0; n < 20; ++n) {
    bench.steps(1);
    for (int j = 0; j < 12; ++j)
      ASSERT_NEAR(torque(bench, j), direction(j) * (0.2 + 0.01 * j), 1e-6) << n << " " << j;
  }
}

TEST_P(Torques, OfATorqueServoAreItsLaw) {
  robot::RobotSpec robot = weightless(scene("pendulum"));
  robot.joints[0].servo = {
      .mode = robot::ServoMode::torque, .max_torque_nm = 2.0, .kp_nm_per_rad = 20.0, .kd_nm_s_per_rad = 0.0};
  Bench bench(GetParam(), robot, 0.001, true);
  bench.targets.at(0, 0) = 0.15f;
  for (int n = 0; n < 300; ++n) {
    bench.steps(1);
    // By the angle after the step.
    const double expected = std::clamp(20.0 * (static_cast<double>(0.15f) - bench.angle(0)), -2.0, 2.0);
    ASSERT_NEAR(torque(bench, 0), expected, 1e-4) << n;
  }
}

TEST_P(Torques, AreZeroWithoutAMotorWhateverStopsAndGroundDo) {
  // A leg dangles from a quadruped that stumbles about: what a stop gave, in this step or in the one before,
  // is no torque of a motor.
  Bench bench(GetParam(), limping(quadruped()), 0.01, true);
  Stream stream(4, Purpose::test);
  int at_stops = 0, left_stops = 0;
  std::vector<bool> was_at_stop(3);
  for (int n = 0; n < 400; ++n) {
    for (int j = 0; n % 20 == 0 && j < 12; ++j)
      bench.targets.at(j, 0) = static_cast<float>(stream.uniform(-0.8, 0.8));
    bench.steps(1);
    ASSERT_TRUE(bench.engine->healthy(0));
    for (int j = 0; j < 3; ++j) {
      ASSERT_NEAR(torque(bench, j), 0.0, 1e-6) << n << ' ' << j;
      const robot::Joint& joint = bench.robot.joints[static_cast<std::size_t>(j)];
      const bool at_stop = bench.angle(j) <= joint.lower_rad || bench.angle(j) >= joint.upper_rad;
      at_stops += at_stop ? 1 : 0;
      left_stops += was_at_stop[static_cast<std::size_t>(j)] && !at_stop ? 1 : 0;
      was_at_stop[static_cast<std::size_t>(j)] = at_stop;
    }
  }
  EXPECT_GT(at_stops, 50);
  EXPECT_GT(left_stops, 10);
}

}  // namespace
}  // namespace amble::physics
