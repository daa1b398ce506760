#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/physics/scene.hpp"

namespace amble::physics {
namespace {

class PassiveJoint : public OnEachEngine {};
ON_EACH_ENGINE(PassiveJoint);
class JointWithoutMotor : public OnEachEngine {};
ON_EACH_ENGINE(JointWithoutMotor);
class StiffServo : public OnEachEngine {};
ON_EACH_ENGINE(StiffServo);

/// Moment of inertia of the pendulum about its hinge: 0.03 about its centre, 1 kg at 0.5 m.
constexpr double inertia = 0.28;

/// A pendulum without weight whose motor pushes with this torque, whatever its speed.
robot::RobotSpec pushed_arm(double torque_nm) {
  robot::RobotSpec robot = weightless(scene("pendulum"));
  robot.joints[0].servo = {.mode = robot::ServoMode::velocity, .gain_per_s = 1e5, .max_torque_nm = torque_nm};
  robot.contact.cfm_s_per_kg = 1e-9;
  return robot;
}

TEST_P(PassiveJoint, ArmatureAddsToTheInertia) {
  const double h = 0.001;
  for (const double armature : {0.0, 0.07, 0.28, 5.0}) {
    robot::RobotSpec robot = pushed_arm(0.4);
    robot.joints[0].armature_kg_m2 = armature;
    Bench bench(GetParam(), robot, h);
    bench.targets.at(0, 0) = 2.5f;
    bench.steps(400);
    const double expected = 0.4 / (inertia + armature) * h * h * 400 * 401 / 2;
    EXPECT_NEAR(bench.angle(0), expected, 1e-3 * expected) << armature;
  }
}

TEST_P(PassiveJoint, DampingActsOnTheSpeedAfterTheStep) {
  // q̇⁺ = (q̇ + h T / I) / (1 + h d / I): stable at any damping, with the speed T / d in the end.
  for (const double h : {0.01, 0.001})
    for (const double damping : {0.1, 3.0, 2800.0}) {
      const double torque = std::min(0.4, damping);
      robot::RobotSpec robot = pushed_arm(torque);
      robot.joints[0].damping_nm_s_per_rad = damping;
      Bench bench(GetParam(), robot, h);
      bench.targets.at(0, 0) = 2.5f;
      double speed = 0.0, angle = 0.0;
      for (int n = 0; n < 100; ++n) {
        bench.steps(1);
        speed = (speed + h * torque / inertia) / (1.0 + h * damping / inertia);
        angle += h * speed;
        ASSERT_NEAR(bench.angle(0), angle, 1e-3 * angle + 1e-6) << h << " " << damping << " " << n;
      }
    }
}

TEST_P(PassiveJoint, FrictionOpposesTheMotionAndHoldsAtRest) {
  const double h = 0.001, friction = 0.3;
  robot::RobotSpec robot = pushed_arm(0.29);
  robot.joints[0].friction_loss_nm = friction;
  Bench weaker(GetParam(), robot, h);
  weaker.targets.at(0, 0) = 2.5f;
  weaker.steps(500);
  EXPECT_NEAR(weaker.angle(0), 0.0, 1e-4);

  robot.joints[0].servo.max_torque_nm = 0.5;
  Bench stronger(GetParam(), robot, h);
  stronger.targets.at(0, 0) = 2.5f;
  stronger.steps(500);
  const double expected = (0.5 - friction) / inertia * h * h * 500 * 501 / 2;
  EXPECT_NEAR(stronger.angle(0), expected, 2e-3 * expected);
}

TEST_P(PassiveJoint, FrictionHoldsAPendulumOrStopsItAfterOneSwing) {
  // The weight's moment at 0.2 rad off the vertical is 9.8 × 0.5 × sin 0.2 = 0.973 N m. A weaker friction
  // lets it swing to as far behind the angle where both are equal as it was before.
  for (const double friction : {0.99, 0.95, 0.8}) {
    robot::RobotSpec robot = scene("pendulum");
    robot.contact.cfm_s_per_kg = 1e-9;
    robot.joints[0].servo.max_torque_nm = 0.0;
    robot.joints[0].friction_loss_nm = friction;
    Bench bench(GetParam(), robot, 0.001);
    bench.steps(2000);
    const double equal_rad = std::asin(friction / 4.9);
    const double swing = friction > 4.9 * std::sin(0.2) ? 0.0 : -2.0 * (0.2 - equal_rad);
    EXPECT_NEAR(bench.angle(0), swing, 5e-4) << friction;
  }
}

TEST_P(PassiveJoint, AllAtOnceObeyTheirSum) {
  const double h = 0.002, armature = 0.1, damping = 0.2, friction = 0.05, torque = 0.6;
  robot::RobotSpec robot = pushed_arm(torque);
  robot.joints[0].armature_kg_m2 = armature;
  robot.joints[0].damping_nm_s_per_rad = damping;
  robot.joints[0].friction_loss_nm = friction;
  Bench bench(GetParam(), robot, h);
  bench.targets.at(0, 0) = 2.5f;
  double speed = 0.0, angle = 0.0;
  for (int n = 0; n < 300; ++n) {
    bench.steps(1);
    speed =
        (speed + h * (torque - friction) / (inertia + armature)) / (1 + h * damping / (inertia + armature));
    angle += h * speed;
    ASSERT_NEAR(bench.angle(0), angle, 2e-3 * angle + 1e-5) << n;
  }
}

/// A pendulum that no motor moves.
robot::RobotSpec free_arm(robot::RobotSpec robot) {
  robot.joints[0].servo = {.mode = robot::ServoMode::none, .gain_per_s = 0.0, .max_torque_nm = 0.0};
  robot.joints[0].command = robot::AngleRange{};
  robot.legs.clear();
  robot.joint_types.clear();
  robot.contact.cfm_s_per_kg = 1e-9;
  return robot;
}

TEST_P(JointWithoutMotor, SwingsAndDiesAwayAsADampedPendulum) {
  // I q̈ = −m g d sin(q + a) − c q̇ from 0 at rest, a = 0.05 rad off the vertical, where it is linear to 4e-4:
  // q + a = a e^(−λ t) (cos ω t + λ/ω sin ω t), λ = c / 2 I, ω² = m g d / I − λ².
  const double h = 0.0005, off = 0.05, weight = 9.8 * 0.5, damping = 0.3;
  robot::RobotSpec robot = free_arm(scene("pendulum"));
  robot.joints[0].damping_nm_s_per_rad = damping;
  Bench bench(GetParam(), robot, h);
  // It hangs 0.2 rad off: nearer to the vertical at first.
  bench.engine->place_at(0, {{robot.bodies[0].position_m, robot.bodies[0].rotation}, {-0.2 + off}});
  const double rate = damping / (2.0 * inertia), omega = std::sqrt(weight / inertia - rate * rate);
  double largest = 0.0;
  for (int n = 1; n <= 6000; ++n) {
    bench.steps(1);
    const double t = n * h;
    const double expected =
        off * std::exp(-rate * t) * (std::cos(omega * t) + rate / omega * std::sin(omega * t));
    largest = std::max(largest, std::abs(bench.angle(0) + 0.2 - expected));
  }
  EXPECT_LT(largest, 0.01 * off);
}

TEST_P(JointWithoutMotor, ItsSpringFollowsBackwardEulerAtAnyStiffness) {
  const double tolerance = std::string(GetParam()) == "ode" ? 1e-2 : 3e-4;
  for (const double h : {0.01, 0.001})
    for (const double stiffness : {1.0, 100.0, 1e4})
      for (const double damping : {0.0, 0.5}) {
        robot::RobotSpec robot = free_arm(weightless(scene("pendulum")));
        robot.joints[0].stiffness_nm_per_rad = stiffness;
        robot.joints[0].damping_nm_s_per_rad = damping;
        robot.joints[0].rest_rad = 0.5;
        Bench bench(GetParam(), robot, h);
        double speed = 0.0, angle = 0.0;
        for (int n = 0; n < 200; ++n) {
          bench.steps(1);
          speed = (speed + h * stiffness * (0.5 - angle) / inertia) /
                  (1.0 + h * (stiffness * h + damping) / inertia);
          angle += h * speed;
          ASSERT_NEAR(bench.angle(0), angle, tolerance)
              << h << " " << stiffness << " " << damping << " " << n;
        }
      }
}

TEST_P(JointWithoutMotor, ItsSpringPressesAgainstAStopBeforeItsRest) {
  robot::RobotSpec robot = free_arm(weightless(scene("pendulum")));
  robot.joints[0].upper_rad = 0.1;
  robot.joints[0].damping_nm_s_per_rad = 1.0;
  robot.joints[0].stiffness_nm_per_rad = 5.0;
  robot.joints[0].rest_rad = 0.6;
  Bench bench(GetParam(), robot);
  bench.steps(300);
  EXPECT_NEAR(bench.angle(0), 0.1, 2e-3);
}

TEST_P(JointWithoutMotor, HearsNoTargetAndReportsNoTorque) {
  robot::RobotSpec robot = free_arm(scene("pendulum"));
  robot.joints[0].stiffness_nm_per_rad = 2.0;
  robot.joints[0].rest_rad = -0.5;  // it is drawn to the stop
  robot.joints[0].lower_rad = -0.1;
  Bench still(GetParam(), robot, 0.01, true), called(GetParam(), robot, 0.01, true);
  called.targets.at(0, 0) = 2.5f;
  for (int n = 0; n < 100; ++n) {
    still.steps(1);
    called.steps(1);
    ASSERT_EQ(still.engine->state_hash(0), called.engine->state_hash(0)) << n;
    ASSERT_EQ(called.engine->motor_torque_nm()->at(0, 0), 0.0f) << n;
  }
  EXPECT_LT(still.angle(0), -0.05);
}

TEST_P(JointWithoutMotor, TurnsOnAndOn) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  robot::RobotSpec robot = free_arm(weightless(scene("pendulum")));
  robot.joints[0].lower_rad = -infinity;
  robot.joints[0].upper_rad = infinity;
  Bench bench(GetParam(), robot, 0.001);
  MovingPose motion = bench.engine->motion(0);
  motion.joint_speed_rad_s = {9.0};
  bench.engine->place_moving(0, motion);
  const double before = bench.engine->motion(0).joint_speed_rad_s[0];
  bench.steps(2000);
  EXPECT_NEAR(bench.angle(0), 18.0, 0.2);
  EXPECT_NEAR(bench.engine->motion(0).joint_speed_rad_s[0], before, 0.1);
}

TEST_P(StiffServo, FollowsBackwardEulerAtAnyStiffness) {
  // Explicitly, h² kp / I = 3.6 and more would blow up. ODE moves bodies along tangents, and so with
  // an error of (h ω)² / 2 of the arm's length in a step, which it corrects later.
  const double tolerance = std::string(GetParam()) == "ode" ? 1e-2 : 3e-4;
  for (const double h : {0.01, 0.001})
    for (const double kp : {1.0, 100.0, 1e4})
      for (const double kd : {0.0, 1.0, 50.0}) {
        robot::RobotSpec robot = weightless(scene("pendulum"));
        robot.contact.cfm_s_per_kg = 1e-9;  // ODE's bearings have it, too
        robot.joints[0].servo = {.mode = robot::ServoMode::torque,
                                 .max_torque_nm = 1e6,
                                 .kp_nm_per_rad = kp,
                                 .kd_nm_s_per_rad = kd};
        Bench bench(GetParam(), robot, h);
        bench.targets.at(0, 0) = 0.5f;
        double speed = 0.0, angle = 0.0;
        for (int n = 0; n < 200; ++n) {
          bench.steps(1);
          speed = (speed + h * kp * (0.5 - angle) / inertia) / (1.0 + h * (kp * h + kd) / inertia);
          angle += h * speed;
          ASSERT_NEAR(bench.angle(0), angle, tolerance) << h << " " << kp << " " << kd << " " << n;
        }
      }
}

TEST_P(StiffServo, GivesNoMoreThanItsLargestTorque) {
  const double h = 0.01;
  robot::RobotSpec robot = weightless(scene("pendulum"));
  robot.joints[0].servo = {
      .mode = robot::ServoMode::torque, .max_torque_nm = 0.2, .kp_nm_per_rad = 1e4, .kd_nm_s_per_rad = 1.0};
  Bench bench(GetParam(), robot, h);
  bench.targets.at(0, 0) = 2.0f;
  bench.steps(50);
  const double expected = 0.2 / inertia * h * h * 50 * 51 / 2;
  EXPECT_NEAR(bench.angle(0), expected, 1e-3 * expected);
}

TEST_P(StiffServo, LeavesAStopTowardsItsTarget) {
  robot::RobotSpec robot = scene("pendulum");
  robot.joints[0].lower_rad = -0.1;
  robot.joints[0].servo = {
      .mode = robot::ServoMode::torque, .max_torque_nm = 0.0, .kp_nm_per_rad = 50.0, .kd_nm_s_per_rad = 1.0};
  robot.joints[0].servo.max_torque_nm = 20.0;
  Bench bench(GetParam(), robot);
  bench.targets.at(0, 0) = -1.0f;  // clamped to the stop
  bench.steps(200);
  EXPECT_NEAR(bench.angle(0), -0.1, 0.02);
  bench.targets.at(0, 0) = 1.0f;
  bench.steps(300);
  // kp (1 − q) = m g d sin(q + 0.2) at rest.
  double q = 1.0;
  for (int i = 0; i < 100; ++i) q = 1.0 - 9.8 * 0.5 * std::sin(q + 0.2) / 50.0;
  EXPECT_NEAR(bench.angle(0), q, 2e-3);
}

}  // namespace
}  // namespace amble::physics
