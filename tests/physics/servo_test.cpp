#include <gtest/gtest.h>

#include <cmath>

#include "tests/physics/scene.hpp"

namespace amble::physics {
namespace servo_test {

class VelocityServo : public OnEachEngine {};
ON_EACH_ENGINE(VelocityServo);
class TorqueServo : public OnEachEngine {};
ON_EACH_ENGINE(TorqueServo);
class Servo : public OnEachEngine {};
ON_EACH_ENGINE(Servo);

/// Moment of inertia of the pendulum about its hinge: 0.03 about its centre, 1 kg at 0.5 m.
constexpr double inertia = 0.28;

robot::RobotSpec arm(const robot::Servo& servo) {
  robot::RobotSpec robot = weightless(scene("pendulum"));
  robot.joints[0].servo = servo;
  return robot;
}

TEST_P(VelocityServo, ApproachesItsTargetAtFirstOrder) {
  // Speed = gain × (target − angle), held for a step: the rest shrinks by (1 − gain h) per step.
  for (const double h : {0.01, 0.001}) {
    Bench bench(GetParam(),
                arm({.mode = robot::ServoMode::velocity, .gain_per_s = 9.0, .max_torque_nm = 1e4}), h);
    bench.targets.at(0, 0) = 0.5f;
    for (int n = 1; n <= 100; ++n) {
      bench.steps(1);
      ASSERT_NEAR(bench.angle(0), 0.5 * (1.0 - std::pow(1.0 - 9.0 * h, n)), 1e-4) << n;
    }
  }
}

TEST_P(VelocityServo, PushesNoHarderThanItsLimit) {
  Bench bench(GetParam(), arm({.mode = robot::ServoMode::velocity, .gain_per_s = 9.0, .max_torque_nm = 0.4}),
              0.001);
  bench.targets.at(0, 0) = 2.5f;
  bench.steps(500);
  const double expected = 0.5 * (0.4 / inertia) * 0.5 * 0.501;
  EXPECT_NEAR(bench.angle(0), expected, 1e-3 * expected);
}

TEST_P(VelocityServo, TurnsBothWays) {
  for (const float target : {-0.7f, 0.7f}) {
    Bench bench(GetParam(),
                arm({.mode = robot::ServoMode::velocity, .gain_per_s = 9.0, .max_torque_nm = 50.0}));
    bench.targets.at(0, 0) = target;
    bench.steps(300);
    EXPECT_NEAR(bench.angle(0), static_cast<double>(target), 1e-4);
  }
}

TEST_P(TorqueServo, SwingsAsADampedOscillator) {
  // I a'' + kd a' + kp (a − target) = 0 from rest.
  const double kp = 20.0, kd = 1.2, target = 0.4, h = 0.0005;
  Bench bench(GetParam(),
              arm({.mode = robot::ServoMode::torque,
                   .max_torque_nm = 1e4,
                   .kp_nm_per_rad = kp,
                   .kd_nm_s_per_rad = kd}),
              h);
  bench.targets.at(0, 0) = static_cast<float>(target);
  const double decay = kd / (2 * inertia);
  const double omega = std::sqrt(kp / inertia - decay * decay);
  for (int n = 1; n <= 2000; ++n) {
    bench.steps(1);
    const double t = n * h;
    const double expected =
        target * (1 - std::exp(-decay * t) * (std::cos(omega * t) + decay / omega * std::sin(omega * t)));
    ASSERT_NEAR(bench.angle(0), expected, 2e-3) << t;
  }
}

TEST_P(TorqueServo, ClampsItsTorque) {
  Bench bench(GetParam(),
              arm({.mode = robot::ServoMode::torque, .max_torque_nm = 0.4, .kp_nm_per_rad = 1000.0}), 0.001);
  for (const double sign : {1.0, -1.0}) {
    bench.engine->place(0);
    bench.targets.at(0, 0) = static_cast<float>(2.5 * sign);
    bench.steps(500);
    const double expected = sign * 0.5 * (0.4 / inertia) * 0.5 * 0.501;
    EXPECT_NEAR(bench.angle(0), expected, 1e-3 * std::abs(expected));
  }
}

TEST_P(TorqueServo, MovesAUniversalJointAsTheVelocityServoDoes) {
  robot::RobotSpec robot = weightless(quadruped());
  for (robot::Joint& joint : robot.joints) {
    joint.servo = {
        .mode = robot::ServoMode::torque, .max_torque_nm = 5.0, .kp_nm_per_rad = 5.0, .kd_nm_s_per_rad = 0.5};
  }
  Bench bench(GetParam(), robot, 0.002);
  for (int leg = 0; leg < 4; ++leg) {
    bench.targets.at(3 * leg, 0) = leg < 2 ? -0.5f : 0.4f;
    bench.targets.at(3 * leg + 1, 0) = leg % 2 == 0 ? 0.3f : -0.6f;
    bench.targets.at(3 * leg + 2, 0) = 0.2f;
  }
  bench.steps(5000);
  for (int j = 0; j < 12; ++j)
    EXPECT_NEAR(bench.angle(j), static_cast<double>(bench.targets.at(j, 0)), 0.01) << j;
}

TEST_P(Servo, FeelsTheInertiaOfTurnedPrincipalAxes) {
  // Principal axes turned by 90° about x: about the hinge's y now lies the moment that was third, 0.01
  // instead of 0.03.
  robot::RobotSpec robot =
      arm({.mode = robot::ServoMode::torque, .max_torque_nm = 0.4, .kp_nm_per_rad = 1000.0});
  robot.bodies[1].inertia_rotation = axis_angle({1.0, 0.0, 0.0}, std::acos(0.0));
  Bench bench(GetParam(), robot, 0.001);
  bench.targets.at(0, 0) = 2.5f;
  bench.steps(500);
  const double expected = 0.5 * (0.4 / 0.26) * 0.5 * 0.501;
  EXPECT_NEAR(bench.angle(0), expected, 1e-3 * expected);
}

TEST_P(Servo, ClampsTargetsToTheStops) {
  for (const float target : {1e30f, -1e30f, std::numeric_limits<float>::infinity()}) {
    Bench bench(GetParam(),
                arm({.mode = robot::ServoMode::velocity, .gain_per_s = 9.0, .max_torque_nm = 50.0}));
    bench.targets.at(0, 0) = target;
    bench.steps(300);
    EXPECT_TRUE(bench.engine->healthy(0));
    EXPECT_NEAR(bench.angle(0), target > 0 ? 3.0 : -3.0, 1e-2);
  }
}

}  // namespace servo_test
}  // namespace amble::physics
