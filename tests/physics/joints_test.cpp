#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/core/random.hpp"
#include "tests/physics/scene.hpp"
#include "tests/robot/legged.hpp"

namespace amble::physics {
namespace {

class Joints : public OnEachEngine {};
ON_EACH_ENGINE(Joints);
class SelfCollision : public OnEachEngine {};
ON_EACH_REFEREE(SelfCollision);

std::vector<double> angles(const Bench& bench) {
  std::vector<double> values;
  for (int j = 0; j < static_cast<int>(bench.robot.joints.size()); ++j) values.push_back(bench.angle(j));
  return values;
}

Vec3 foot_position(const Bench& bench, int leg) {
  const robot::Geom& foot =
      bench.robot
          .geoms[static_cast<std::size_t>(bench.robot.legs[static_cast<std::size_t>(leg)].foot_geoms[0])];
  // Seen from the root: with the root's frame as the world.
  return kinematics(bench.robot, {}, angles(bench))[static_cast<std::size_t>(foot.body)] * foot.position_m;
}

TEST_P(Joints, MeasuredAnglesPutTheBodiesWhereTheyAre) {
  // The whole robot's centre of mass, from ODE's bodies, against forward kinematics from root pose and joint
  // angles. A flipped sign, a wrong axis or a wrong order of the hip's two axes moves it by centimetres.
  for (const char* variant : {"authors", "paper"}) {
    robot::RobotSpec robot = weightless(quadruped(variant));
    robot.contact.cfm_s_per_kg = 1e-9;  // stiff joints
    Bench bench(GetParam(), robot);
    Stream stream(11, Purpose::test);
    for (int n = 0; n < 1000; ++n) {
      if (n % 100 == 0) {
        for (int j = 0; j < 12; ++j) {
          const robot::Joint& joint = bench.robot.joints[static_cast<std::size_t>(j)];
          bench.targets.at(j, 0) = static_cast<float>(stream.uniform(joint.lower_rad, joint.upper_rad));
        }
      }
      bench.steps(1);
      const auto poses = kinematics(bench.robot, bench.engine->root_pose(0), angles(bench));
      Vec3 com;
      for (std::size_t b = 0; b < poses.size(); ++b) {
        com = com + (bench.robot.bodies[b].mass_kg / 5.4) * (poses[b] * bench.robot.bodies[b].com_m);
      }
      ASSERT_NEAR(norm(com - bench.engine->com_m(0)), 0.0, 2e-3) << variant << " step " << n;
    }
  }
}

TEST_P(Joints, SignsAreThoseOfTheConventions) {
  // Leg by leg, the foot's way in the root's frame when one joint alone goes to a target.
  struct Case {
    int type;
    float target;
    Vec3 way;
  };
  for (int leg = 0; leg < 4; ++leg) {
    const bool front = leg < 2;
    const double outward = leg % 2 == 0 ? 1.0 : -1.0;
    const std::vector<Case> cases{{0, front ? -0.8f : 0.8f, {front ? 1.0 : -1.0, 0.0, 0.0}},
                                  {1, 0.5f, {-1.0, 0.0, 0.0}},
                                  {1, -0.5f, {1.0, 0.0, 0.0}},
                                  {2, 0.4f, {0.0, outward, 0.0}}};
    for (const Case& one : cases) {
      Bench bench(GetParam(), weightless(quadruped()));
      const Vec3 before = foot_position(bench, leg);
      const Vec3 root_before = bench.engine->root_pose(0).position_m;
      bench.targets.at(3 * leg + one.type, 0) = one.target;
      bench.steps(200);
      EXPECT_NEAR(bench.angle(3 * leg + one.type), static_cast<double>(one.target), 1e-2);
      EXPECT_GT(dot(foot_position(bench, leg) - before, one.way), 0.15) << leg << " " << one.type;
      // The rest of the robot recoils.
      EXPECT_LT(dot(bench.engine->root_pose(0).position_m - root_before, one.way), -1e-3)
          << leg << " " << one.type;
    }
  }
}

TEST_P(Joints, APendulumSwingsWithItsPeriod) {
  // T = 2 π sqrt(I / (m g d)) (1 + a²/16 + 11 a⁴/3072) for amplitude a = 0.2 rad about the vertical, angle
  // −0.2.
  const double expected =
      2 * std::numbers::pi * std::sqrt(0.28 / (9.8 * 0.5)) * (1 + 0.04 / 16 + 11 * 0.0016 / 3072);
  const double h = 0.001;
  Bench bench(GetParam(), scene("pendulum"), h);
  std::vector<double> crossings;
  double before = 0.0;
  for (int n = 1; n <= 8000; ++n) {
    bench.steps(1);
    const double now = bench.angle(0);
    EXPECT_LT(std::abs(now + 0.2), 0.2005);
    if (before > -0.2 && now <= -0.2) crossings.push_back((n - (-0.2 - now) / (before - now)) * h);
    before = now;
  }
  ASSERT_GE(crossings.size(), 5u);
  const double period = (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
  EXPECT_NEAR(period, expected, 1e-3 * expected);
}

TEST_P(Joints, StopsHold) {
  robot::RobotSpec robot = scene("pendulum");
  robot.joints[0].lower_rad = -0.1;
  Bench bench(GetParam(), robot);
  double lowest = 0.0;
  for (int n = 0; n < 500; ++n) {
    bench.steps(1);
    lowest = std::min(lowest, bench.angle(0));
  }
  EXPECT_NEAR(lowest, -0.1, 0.02);          // overshoot of at most one step's way
  EXPECT_NEAR(bench.angle(0), -0.1, 1e-4);  // and comes to rest there, against its weight
}

TEST_P(SelfCollision, LetsLegsPassThroughEachOtherUnlessItIsOn) {
  // Left front leg back, left hind leg forward: their feet would cross.
  const auto meeting = [&](bool self_collision) {
    robot::RobotSpec robot = weightless(quadruped());
    robot.self_collision = self_collision;
    Bench bench(GetParam(), robot);
    bench.targets.at(1, 0) = 0.8f;
    bench.targets.at(7, 0) = -0.8f;
    bench.steps(300);
    EXPECT_TRUE(bench.engine->healthy(0));
    return bench.angle(1) - bench.angle(7);
  };
  EXPECT_NEAR(meeting(false), 1.6, 0.01);
  EXPECT_LT(meeting(true), 1.3);
}

TEST(MujocoSelfCollision, OfAllLegsAtOnceLosesNoContact) {
  // Six large feet push each other apart, more pairs than there are places to touch the ground: the left legs
  // move like the right ones.
  robot::RobotSpec robot = weightless(tests::legged_robot(3));
  robot.self_collision = true;
  for (const robot::Leg& leg : robot.legs) robot.geoms[to_index(leg.foot_geoms[0])].size_m = {0.45, 0.0, 0.0};
  Bench bench("mujoco", robot);
  bench.steps(5);
  ASSERT_TRUE(bench.engine->healthy(0));
  for (std::size_t leg = 0; leg < 6; leg += 2)
    for (std::size_t type = 0; type < 3; ++type) {
      const int left = robot.legs[leg].joints[type], right = robot.legs[leg + 1].joints[type];
      EXPECT_NEAR(bench.angle(left), bench.angle(right), 1e-6) << robot.joints[to_index(left)].name;
    }
  EXPECT_GT(bench.angle(robot.legs[0].joints[2]), 0.01) << "they do push";
}

TEST_P(SelfCollision, LeavesStandingAlone) {
  robot::RobotSpec robot = quadruped();
  robot.self_collision = true;
  Bench with(GetParam(), robot);
  Bench without(GetParam(), quadruped());
  with.steps(100);
  without.steps(100);
  EXPECT_EQ(with.engine->state_hash(0), without.engine->state_hash(0));
}

}  // namespace
}  // namespace amble::physics
