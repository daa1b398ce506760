#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/physics/scene.hpp"

namespace amble::physics {
namespace {

class Standing : public OnEachEngine {};
ON_EACH_ENGINE(Standing);
class Touch : public OnEachEngine {};
ON_EACH_ENGINE(Touch);

TEST_P(Standing, ABoxSinksUntilTheContactSpringsCarryItsWeight) {
  // Four corners, each a spring of erp / (h cfm): depth = m g h cfm / (4 erp).
  robot::RobotSpec robot = scene("box");
  robot.contact.cfm_s_per_kg = 1e-4;
  for (const double h : {0.01, 0.002}) {
    Bench bench(GetParam(), robot, h);
    bench.steps(2000);
    const double depth = 2.0 * 9.8 * h * 1e-4 / (4 * 0.2);
    EXPECT_NEAR(0.1 - bench.engine->com_m(0).z, depth, 1e-3 * depth);
    EXPECT_NEAR(norm(bench.engine->momentum_kg_m_s(0)), 0.0, single_precision() ? 1e-6 : 1e-9);
  }
}

TEST_P(Standing, ABallBouncesByTheLawOfSoftContacts) {
  // In contact v⁺ + cfm f = (erp/h) depth with f ≥ 0 (ODE manual, "Soft constraint"), and m (v⁺ − v) =
  // h (f − m g): step by step, from the fall to rest, for contacts from hard to as yielding as the ball.
  const double h = 0.01, mass = 2.0;
  for (const double cfm : {1e-4, 1e-3, 5e-3, 2e-2}) {
    robot::RobotSpec robot = lifted(scene("box"), 0.1);
    robot.geoms[0].shape = robot::Shape::sphere;
    robot.contact.cfm_s_per_kg = cfm;
    robot.contact.erp = 0.6;
    Bench bench(GetParam(), robot, h);
    double above_m = 0.1, speed = 0.0;
    int in_contact = 0;
    for (int n = 0; n < 100; ++n) {
      const double falling = speed - 9.8 * h;
      const bool touches = above_m <= 0.0;
      const double force = touches ? std::max(0.0, (-0.6 / h * above_m - falling) / (cfm + h / mass)) : 0.0;
      speed = falling + h / mass * force;
      above_m += h * speed;
      in_contact += touches ? 1 : 0;
      bench.steps(1);
      ASSERT_NEAR(bench.engine->momentum_kg_m_s(0).z, mass * speed, 2e-4) << cfm << ' ' << n;
      ASSERT_NEAR(bench.engine->com_m(0).z - 0.1, above_m, 2e-5) << cfm << ' ' << n;
    }
    EXPECT_GT(in_contact, 10) << cfm;
  }
}

TEST_P(Standing, TheQuadrupedStandsStillOnAllFeet) {
  for (const char* variant : {"authors", "paper"}) {
    Bench bench(GetParam(), quadruped(variant));
    bench.steps(300);
    const Vec3 before = bench.engine->com_m(0);
    for (int i = 0; i < 300; ++i) {
      bench.steps(1);
      for (int leg = 0; leg < 4; ++leg) ASSERT_TRUE(bench.touches(leg)) << "step " << i;
    }
    // The forces of the ground balance the weight: no momentum comes or goes.
    EXPECT_NEAR(norm(bench.engine->momentum_kg_m_s(0)), 0.0, single_precision() ? 3e-3 : 1e-3);
    EXPECT_NEAR(norm(bench.engine->com_m(0) - before), 0.0, 1e-3);
    EXPECT_NEAR(bench.engine->root_com_m(0).z, 0.88404, 1e-3);
  }
}

TEST_P(Touch, IsFeltWhenTheFootIsNotAboveTheGround) {
  const double least = single_precision() ? 1e-6 : 1e-9;
  for (const double gap : {least, 1e-3, 0.5}) {
    const Bench above(GetParam(), lifted(quadruped(), 0.0001 + gap));  // the model puts the feet 0.1 mm deep
    const Bench below(GetParam(), lifted(quadruped(), 0.0001 - least));
    for (int leg = 0; leg < 4; ++leg) {
      EXPECT_FALSE(above.touches(leg)) << gap;
      EXPECT_TRUE(below.touches(leg));
    }
  }
}

TEST_P(Touch, BelongsToThePoseAtTheBeginningOfTheStep) {
  Bench bench(GetParam(), lifted(quadruped(), 0.05));
  for (int i = 0; i < 30; ++i) {
    // In the air the legs stay straight, so that the feet are where the root says.
    const bool down = bench.engine->root_pose(0).position_m.z - 0.88414 <= 0.0;
    bench.steps(1);
    for (int leg = 0; leg < 4; ++leg) ASSERT_EQ(bench.touches(leg), down) << "step " << i;
    if (down) return;
  }
  FAIL() << "never landed";
}

TEST_P(Touch, ALiftedFootFeelsNothingWhileItsNeighboursStand) {
  for (int leg = 0; leg < 4; ++leg) {
    Bench bench(GetParam(), quadruped());
    bench.targets.at(3 * leg, 0) = leg < 2 ? -0.8f : 0.8f;  // bend the knee
    bench.steps(8);
    // The robot leans towards the corner without support, so the foot across may leave the ground as well.
    const int across = 3 - leg;
    for (int other = 0; other < 4; ++other) {
      if (other == across) continue;
      EXPECT_EQ(bench.touches(other), other != leg) << leg << " " << other;
    }
  }
}

}  // namespace
}  // namespace amble::physics
