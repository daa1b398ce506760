#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/physics/scene.hpp"

namespace amble::physics {
namespace {

class Friction : public OnEachEngine {};
ON_EACH_ENGINE(Friction);

/// The box on a slope of this angle, seen by someone who stands upright on the slope; it falls towards +x.
robot::RobotSpec on_slope(double angle_rad, double friction) {
  robot::RobotSpec robot = scene("box");
  robot.gravity_m_s2 = {9.8 * std::sin(angle_rad), 0.0, -9.8 * std::cos(angle_rad)};
  robot.contact.friction = friction;
  return robot;
}

TEST_P(Friction, TheBoxHoldsUpToTheFrictionAngle) {
  // A solver that stops after 20 iterations lets it creep by millimetres per second.
  const double creep_m = single_precision() ? 0.02 : 1e-3;
  for (const double friction : {0.2, 0.5}) {
    Bench bench(GetParam(), on_slope(std::atan(0.98 * friction), friction));
    bench.steps(300);
    EXPECT_LT(bench.engine->com_m(0).x, creep_m) << friction;
  }
}

TEST_P(Friction, BeyondTheFrictionAngleTheBoxSlidesWithTheAccelerationLeft) {
  for (const double friction : {0.2, 0.5}) {
    for (const double steeper : {1.05, 1.5}) {
      const double angle = std::atan(steeper * friction);
      Bench bench(GetParam(), on_slope(angle, friction), 0.001);
      bench.steps(100);
      const double before = bench.engine->momentum_kg_m_s(0).x;
      bench.steps(900);
      const double acceleration = (bench.engine->momentum_kg_m_s(0).x - before) / (2.0 * 0.9);
      const double expected = 9.8 * (std::sin(angle) - friction * std::cos(angle));
      EXPECT_NEAR(acceleration, expected, 0.01 * expected) << friction << " " << steeper;
    }
  }
}

TEST_P(Friction, FrictionIsACoefficientNotAForce) {
  // Ten times the mass must slide just the same.
  robot::RobotSpec robot = on_slope(std::atan(0.6), 0.5);
  robot.bodies[0].mass_kg *= 10.0;
  robot.bodies[0].inertia_kg_m2 = 10.0 * robot.bodies[0].inertia_kg_m2;
  robot.contact.cfm_s_per_kg *= 0.1;
  Bench heavy(GetParam(), robot, 0.001);
  Bench light(GetParam(), on_slope(std::atan(0.6), 0.5), 0.001);
  heavy.steps(500);
  light.steps(500);
  EXPECT_NEAR(heavy.engine->com_m(0).x, light.engine->com_m(0).x, 1e-3 * light.engine->com_m(0).x);
}

TEST_P(Friction, InfiniteFrictionHoldsOnAnySlope) {
  Bench bench(GetParam(), on_slope(0.7, std::numeric_limits<double>::infinity()));
  bench.steps(300);
  EXPECT_LT(std::abs(bench.engine->com_m(0).x), 1e-3);
}

TEST_P(Friction, ASledComesToRestAfterTheDistanceThatFrictionAllows) {
  const double h = 0.001;
  Bench bench(GetParam(), scene("sled"), h);
  bench.targets.at(0, 0) = bench.targets.at(1, 0) = 1.6f;
  const auto speed = [&] { return bench.engine->momentum_kg_m_s(0).x / 3.0; };

  int waited = 0;
  while (bench.angle(0) < 1.5707 && waited < 1000) {
    bench.steps(1);
    ++waited;
  }
  ASSERT_LT(waited, 1000);
  bench.steps(20);
  const double v0 = speed();
  const double x0 = bench.engine->com_m(0).x;
  ASSERT_GT(v0, 0.3);

  // v = v0 − μ g t until it stands still after v0² / (2 μ g).
  const double deceleration = 0.3 * 9.8;
  const int half = static_cast<int>(0.5 * v0 / deceleration / h);
  bench.steps(half);
  EXPECT_NEAR(speed(), v0 - deceleration * half * h, 0.01 * v0);
  bench.steps(1000);
  EXPECT_NEAR(speed(), 0.0, 1e-4);
  EXPECT_NEAR(bench.engine->com_m(0).x - x0, v0 * v0 / (2 * deceleration),
              0.01 * v0 * v0 / (2 * deceleration));
  EXPECT_NEAR(bench.engine->com_m(0).y, 0.0, 1e-4);
}

}  // namespace
}  // namespace amble::physics
