#include <gtest/gtest.h>

#include <cmath>

#include "amble/core/random.hpp"
#include "tests/physics/scene.hpp"

namespace amble::physics {
namespace {

class Flight : public OnEachEngine {};
ON_EACH_ENGINE(Flight);
/// Engines that keep the momentum to the last bits.
class ExactFlight : public OnEachEngine {};
ON_ENGINES(ExactFlight, "ode", "batch");

TEST_P(Flight, AFallingBoxFollowsTheParabolaOfTheIntegrator) {
  // Semi-implicit Euler: after n steps v = −g h n and z = z0 − g h² n (n + 1) / 2, exactly.
  const robot::RobotSpec robot = lifted(scene("box"), 50.0);
  for (const double h : {0.01, 0.001}) {
    Bench bench(GetParam(), robot, h);
    const double rounding = single_precision() ? 2e-4 : 1e-10;
    const double z0 = bench.engine->com_m(0).z;
    bench.steps(200);
    EXPECT_NEAR(bench.engine->com_m(0).z, z0 - 9.8 * h * h * 200 * 201 / 2, rounding);
    EXPECT_NEAR(bench.engine->momentum_kg_m_s(0).z, -2.0 * 9.8 * h * 200, rounding);
    EXPECT_EQ(bench.engine->com_m(0).x, 0.0);
  }
}

/// Waves all legs about in the air for two seconds; returns by how much the momentum at most differed from
/// that of free fall, kg m/s, level and upright.
Vec3 momentum_from_nothing(const char* engine, const char* variant, double h) {
  Bench bench(engine, lifted(quadruped(variant), 100.0), h);
  const int per_tick = static_cast<int>(std::lround(0.01 / h));
  const double mass = bench.robot.total_mass_kg();
  Stream stream(7, Purpose::test);
  double largest_angle = 0.0;
  Vec3 largest_error;
  for (int n = 1; n <= 200; ++n) {
    if (n % 20 == 1) {
      for (int j = 0; j < 12; ++j) bench.targets.at(j, 0) = static_cast<float>(stream.uniform(-0.8, 0.8));
    }
    bench.steps(per_tick);
    for (int j = 0; j < 12; ++j) largest_angle = std::max(largest_angle, std::abs(bench.angle(j)));
    const Vec3 momentum = bench.engine->momentum_kg_m_s(0);
    largest_error.x = std::max(largest_error.x, std::abs(momentum.x));
    largest_error.y = std::max(largest_error.y, std::abs(momentum.y));
    largest_error.z = std::max(largest_error.z, std::abs(momentum.z + mass * 9.8 * 0.01 * n));
  }
  EXPECT_GT(largest_angle, 0.5);
  return largest_error;
}

TEST_P(Flight, MotorsCannotChangeTheMomentumOfARobotInTheAir) {
  for (const char* variant : {"authors", "paper"}) {
    const Vec3 error = momentum_from_nothing(GetParam(), variant, 0.01);
    if (drifting()) {
      EXPECT_LT(norm(error), 0.3) << variant;
      EXPECT_LT(norm(momentum_from_nothing(GetParam(), variant, 0.001)), 0.15 * norm(error)) << variant;
    } else {
      EXPECT_LT(error.x, 1e-10) << variant;
      EXPECT_LT(error.y, 1e-10) << variant;
      EXPECT_LT(error.z, single_precision() ? 5e-4 : 1e-9) << variant;
    }
  }
}

TEST_P(ExactFlight, TheCentreOfMassFallsStraightDownHoweverTheLegsWave) {
  Bench bench(GetParam(), lifted(quadruped(), 100.0));
  for (int n = 0; n < 200; ++n) {
    for (int j = 0; j < 12; ++j) bench.targets.at(j, 0) = n / 20 % 2 == j % 2 ? 0.8f : -0.8f;
    bench.steps(1);
  }
  EXPECT_NEAR(bench.engine->com_m(0).x, 0.0, single_precision() ? 1e-7 : 1e-9);
  EXPECT_NEAR(bench.engine->com_m(0).y, 0.0, single_precision() ? 1e-7 : 1e-9);
}

TEST_P(Flight, TheCentreOfMassIsThatOfAllBodies) {
  Bench bench(GetParam(), weightless(quadruped()));
  // By hand: torso 1 kg at 0, four upper legs 0.5 kg at −0.175185, four lower legs 0.5 kg at −0.525555 and
  // feet 0.1 kg at −0.79244.
  const double below = 4 * (0.5 * 0.175185 + 0.5 * 0.525555 + 0.1 * 0.79244) / 5.4;
  EXPECT_NEAR(bench.engine->com_m(0).z, bench.engine->root_com_m(0).z - below,
              single_precision() ? 1e-6 : 1e-12);
}

}  // namespace
}  // namespace amble::physics
