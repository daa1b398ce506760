#include <gtest/gtest.h>

#include "tests/physics/scene.hpp"

namespace amble::physics {
namespace {

class Push : public OnEachEngine {};
ON_EACH_REFEREE(Push);

TEST_P(Push, GivesTheRobotItsImpulseInOneStepAndNoMore) {
  for (const double h : {0.01, 0.001}) {
    Bench bench(GetParam(), weightless(quadruped()), h);
    const Vec3 impulse_n_s{0.7, -0.4, 0.2};
    bench.engine->push(0, impulse_n_s);
    EXPECT_EQ(norm(bench.engine->momentum(0)), 0.0) << "acts in the step, not before";
    for (int n = 0; n < 50; ++n) {
      bench.steps(1);
      ASSERT_NEAR(norm(bench.engine->momentum(0) - impulse_n_s), 0.0, drifting() ? h : 1e-9) << n;
    }
  }
}

TEST_P(Push, ActsOnTheRootsCentreOfMass) {
  // A lone box, pushed there, moves by Δv = impulse / mass and does not turn.
  Bench bench(GetParam(), weightless(scene("box")));
  const Quat before = bench.engine->root_pose(0).rotation;
  const Vec3 from = bench.engine->root_com_m(0);
  bench.engine->push(0, {1.0, 2.0, 0.0});
  bench.steps(1);
  const double mass = bench.robot.total_mass_kg();
  EXPECT_NEAR(norm(bench.engine->root_com_m(0) - from - (0.01 / mass) * Vec3{1.0, 2.0, 0.0}), 0.0, 1e-12);
  EXPECT_EQ(bench.engine->root_pose(0).rotation, before);
}

TEST_P(Push, MovesTheRootFirstAndTheLegsThroughTheirJoints) {
  Bench bench(GetParam(), weightless(quadruped()));
  const double root_m = bench.engine->root_com_m(0).x, all_m = bench.engine->com_m(0).x;
  bench.engine->push(0, {1.0, 0.0, 0.0});
  bench.steps(1);
  EXPECT_GT(bench.engine->root_com_m(0).x - root_m, bench.engine->com_m(0).x - all_m);
}

TEST_P(Push, IsTakenBackByPlacingTheRobotAnew) {
  Bench bench(GetParam(), weightless(quadruped()));
  bench.engine->push(0, {5.0, 0.0, 0.0});
  bench.engine->place(0);
  bench.steps(1);
  EXPECT_NEAR(norm(bench.engine->momentum(0)), 0.0, 1e-12);
}

}  // namespace
}  // namespace amble::physics
