#include <gtest/gtest.h>

#include <cmath>

#include "amble/core/random.hpp"
#include "tests/physics/scene.hpp"

namespace amble::physics {
namespace {

class Flight : public EachEngine {};
INSTANTIATE_TEST_SUITE_P(Engines, Flight, every_engine, engine_of);

TEST_P(Flight, AFallingBoxFollowsTheParabolaOfTheIntegrator) {
  // Semi-implicit Euler: after n steps v = −g h n and z = z0 − g h² n (n + 1) / 2, exactly.
  const morphology::RobotSpec robot = lifted(scene("box"), 50.0);
  for (const double h : {0.01, 0.001}) {
    Bench bench(engine_name(), robot, h);
    const double z0 = bench.engine->com_m(0).z;
    bench.steps(200);
    EXPECT_NEAR(bench.engine->com_m(0).z, z0 - 9.8 * h * h * 200 * 201 / 2, 1e-10);
    EXPECT_NEAR(bench.engine->momentum(0).z, -2.0 * 9.8 * h * 200, 1e-10);
    EXPECT_EQ(bench.engine->com_m(0).x, 0.0);
  }
}

/// Waves all legs about in the air for two seconds; returns by how much the momentum at most differed from
/// that of free fall, kg m/s.
double momentum_from_nothing(std::string_view engine, const char* variant, double h) {
  Bench bench(engine, lifted(quadruped(variant), 100.0), h);
  const double mass = bench.robot.total_mass_kg();
  const int per_tick = static_cast<int>(std::lround(0.01 / h));
  Stream stream(7, Purpose::test);
  double largest_angle = 0.0, largest_error = 0.0;
  for (int n = 1; n <= 200; ++n) {
    if (n % 20 == 1) {
      for (int j = 0; j < 12; ++j) bench.targets.at(j, 0) = static_cast<float>(stream.uniform(-0.8, 0.8));
    }
    bench.steps(per_tick);
    for (int j = 0; j < 12; ++j) largest_angle = std::max(largest_angle, std::abs(bench.angle(j)));
    const Vec3 of_fall{0.0, 0.0, -mass * 9.8 * 0.01 * n};
    largest_error = std::max(largest_error, norm(bench.engine->momentum(0) - of_fall));
  }
  EXPECT_GT(largest_angle, 0.5);
  return largest_error;
}

TEST_P(Flight, MotorsCannotChangeTheMomentumOfARobotInTheAir) {
  for (const char* variant : {"authors", "paper"}) {
    const double error = momentum_from_nothing(engine_name(), variant, 0.01);
    if (engine_name() == "ode") {
      EXPECT_LT(error, 1e-9);
    } else {
      // Joint angles as coordinates keep the momentum to first order in the time step.
      EXPECT_LT(error, 0.3) << variant;
      EXPECT_LT(momentum_from_nothing(engine_name(), variant, 0.001), 0.15 * error) << variant;
    }
  }
}

TEST_P(Flight, TheCentreOfMassIsThatOfAllBodies) {
  Bench bench(engine_name(), weightless(quadruped()));
  // By hand: torso 1 kg at 0, four upper legs 0.5 kg at −0.175185, four lower legs 0.5 kg at −0.525555 and
  // feet 0.1 kg at −0.79244.
  const double below = 4 * (0.5 * 0.175185 + 0.5 * 0.525555 + 0.1 * 0.79244) / 5.4;
  EXPECT_NEAR(bench.engine->com_m(0).z, bench.engine->root_com_m(0).z - below, 1e-12);
}

}  // namespace
}  // namespace amble::physics
