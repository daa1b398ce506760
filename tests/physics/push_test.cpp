#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "amble/physics/batch/batch_engine.hpp"
#include "tests/physics/scene.hpp"

namespace amble::physics {
namespace {

class Push : public OnEachEngine {
 protected:
  /// What rounding may make of `most`, the largest number in play.
  double rounding(double most) const { return (single_precision() ? 4e-7 : 1e-12) * most; }
};
ON_EACH_ENGINE(Push);

TEST_P(Push, GivesTheRobotItsImpulseInOneStepAndNoMore) {
  for (const double h : {0.01, 0.001}) {
    Bench bench(GetParam(), weightless(quadruped()), h);
    const Vec3 impulse_n_s{0.7, -0.4, 0.2};
    bench.engine->push(0, impulse_n_s);
    EXPECT_EQ(norm(bench.engine->momentum_kg_m_s(0)), 0.0) << "acts in the step, not before";
    for (int n = 0; n < 50; ++n) {
      bench.steps(1);
      ASSERT_NEAR(norm(bench.engine->momentum_kg_m_s(0) - impulse_n_s), 0.0, drifting() ? h : rounding(1e3))
          << n;
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
  EXPECT_NEAR(norm(bench.engine->root_com_m(0) - from - (0.01 / mass) * Vec3{1.0, 2.0, 0.0}), 0.0,
              rounding(1.0));
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
  EXPECT_NEAR(norm(bench.engine->momentum_kg_m_s(0)), 0.0, rounding(1.0));
}

TEST_P(Push, AddsUpWithAnotherBeforeTheSameStep) {
  Bench bench(GetParam(), weightless(quadruped()));
  bench.engine->push(0, {0.5, 0.0, 0.0});
  bench.engine->push(0, {0.0, -0.25, 0.0});
  bench.steps(1);
  EXPECT_NEAR(norm(bench.engine->momentum_kg_m_s(0) - Vec3{0.5, -0.25, 0.0}), 0.0,
              drifting() ? 1e-3 : rounding(1.0));
}

TEST(PushOfBatch, GivesTheAngularMomentumOfItsArm) {
  const auto engine = make_batch_engine(weightless(quadruped("paper")), {});
  engine->place(0);
  const Vec3 impulse_n_s{1.0, 0.6, 0.8};
  const Vec3 expected = cross(engine->root_com_m(0) - engine->com_m(0), impulse_n_s);
  EXPECT_GT(norm(expected), 0.05);
  engine->push(0, impulse_n_s);
  engine->step(LaneArray(12, engine->lanes()));
  EXPECT_NEAR(norm(engine->state(0).angular_momentum_kg_m2_s - expected), 0.0, 1e-5);
}

TEST(PushOfBatch, MovesTorsoAndLegsAsInOde) {
  for (const char* variant : {"paper", "authors"}) {
    robot::RobotSpec robot = weightless(quadruped(variant));
    robot.contact.cfm_s_per_kg = 1e-10;  // joints of ODE that hold together
    for (auto& joint : robot.joints) joint.servo = {.mode = robot::ServoMode::torque, .max_torque_nm = 0.0};
    Bench ode("ode", robot, 1e-4), batch("batch", robot, 1e-4);
    for (Bench* const bench : {&ode, &batch}) {
      bench->engine->push(0, {1.0, 0.6, 0.8});
      bench->steps(500);
    }
    const Vec3 moved = ode.engine->root_com_m(0) - Bench("ode", robot).engine->root_com_m(0);
    EXPECT_GT(norm(moved), 0.01);
    EXPECT_NEAR(norm(batch.engine->root_com_m(0) - ode.engine->root_com_m(0)), 0.0, 0.01 * norm(moved));
    double most_rad = 0.0;
    for (int j = 0; j < 12; ++j) {
      most_rad = std::max(most_rad, std::abs(ode.angle(j)));
      EXPECT_NEAR(batch.angle(j), ode.angle(j), 2e-3) << variant << j;
    }
    EXPECT_GT(most_rad, 0.03) << "legs stay behind";
  }
}

}  // namespace
}  // namespace amble::physics
