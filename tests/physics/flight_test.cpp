#include <gtest/gtest.h>

#include <cmath>

#include "amble/core/random.hpp"
#include "tests/physics/scene.hpp"

namespace amble::physics {
namespace {

class Flight : public OnEachEngine {};
ON_EACH_ENGINE(Flight);

TEST_P(Flight, AFallingBoxFollowsTheParabolaOfTheIntegrator) {
  // Semi-implicit Euler: after n steps v = −g h n and z = z0 − g h² n (n + 1) / 2, exactly.
  const morphology::RobotSpec robot = lifted(scene("box"), 50.0);
  for (const double h : {0.01, 0.001}) {
    Bench bench(GetParam(), robot, h);
    const double rounding = single_precision() ? 2e-4 : 1e-10;
    const double z0 = bench.engine->com_m(0).z;
    bench.steps(200);
    EXPECT_NEAR(bench.engine->com_m(0).z, z0 - 9.8 * h * h * 200 * 201 / 2, rounding);
    EXPECT_NEAR(bench.engine->momentum(0).z, -2.0 * 9.8 * h * 200, rounding);
    EXPECT_EQ(bench.engine->com_m(0).x, 0.0);
  }
}

TEST_P(Flight, MotorsCannotChangeTheMomentumOfARobotInTheAir) {
  for (const char* variant : {"authors", "paper"}) {
    Bench bench(GetParam(), lifted(quadruped(variant), 100.0));
    const double rounding = single_precision() ? 5e-4 : 1e-9;
    const double mass = bench.robot.total_mass_kg();
    Stream stream(7, Purpose::test);
    double largest_angle = 0.0;
    for (int n = 1; n <= 200; ++n) {
      if (n % 20 == 1) {
        for (int j = 0; j < 12; ++j) bench.targets.at(j, 0) = static_cast<float>(stream.uniform(-0.8, 0.8));
      }
      bench.steps(1);
      for (int j = 0; j < 12; ++j) largest_angle = std::max(largest_angle, std::abs(bench.angle(j)));
      const Vec3 momentum = bench.engine->momentum(0);
      ASSERT_NEAR(momentum.x, 0.0, 1e-10);
      ASSERT_NEAR(momentum.y, 0.0, 1e-10);
      ASSERT_NEAR(momentum.z, -mass * 9.8 * 0.01 * n, rounding);
    }
    EXPECT_GT(largest_angle, 0.5);
    // The centre of mass falls straight down, as the box does.
    EXPECT_NEAR(bench.engine->com_m(0).x, 0.0, single_precision() ? 1e-7 : 1e-9);
    EXPECT_NEAR(bench.engine->com_m(0).y, 0.0, single_precision() ? 1e-7 : 1e-9);
  }
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
