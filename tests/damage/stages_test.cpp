#include "amble/damage/stages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "amble/core/index.hpp"
#include "amble/core/random.hpp"
#include "amble/robot/check.hpp"
#include "amble/robot/pose.hpp"
#include "tests/damage/scene.hpp"
#include "tests/robot/legged.hpp"

namespace amble::damage {
namespace {

void expect_sound(const robot::RobotSpec& robot) {
  robot::check_robot(robot, [](const std::string& problem) { FAIL() << problem; });
}

TEST(DamageStages, WithoutAMissingLegLeaveARobotThatIsSoundAndOtherwiseTheSame) {
  const auto robot = quadruped();
  for (std::size_t gone = 0; gone < robot.legs.size(); ++gone) {
    const auto stages = stages_of(robot, {{missing(robot.legs[gone].name)}});
    ASSERT_EQ(stages.size(), 1u);
    const robot::RobotSpec& rest = stages[0].robot;
    expect_sound(rest);
    ASSERT_EQ(rest.legs.size(), 3u);
    ASSERT_EQ(rest.joints.size(), 9u);
    const auto before = robot::start_poses(robot), after = robot::start_poses(rest);
    for (std::size_t l = 0; l < rest.legs.size(); ++l) {
      const robot::Leg& leg = rest.legs[l];
      const robot::Leg& was = robot.legs[to_index(stages[0].leg_of[l])];
      EXPECT_EQ(leg.name, was.name);
      EXPECT_EQ(robot::centre_m(rest.geoms[to_index(leg.foot_geoms[0])], after),
                robot::centre_m(robot.geoms[to_index(was.foot_geoms[0])], before));
    }
    for (std::size_t j = 0; j < rest.joints.size(); ++j)
      EXPECT_EQ(rest.joints[j].name, robot.joints[to_index(stages[0].joint_of[j])].name);
    double lost_kg = 0.0;
    for (int b = 0; b < static_cast<int>(robot.bodies.size()); ++b)
      if (robot.leg_of_body(b) == static_cast<int>(gone)) lost_kg += robot.bodies[to_index(b)].mass_kg;
    EXPECT_GT(lost_kg, 0.0);
    EXPECT_NEAR(rest.total_mass_kg(), robot.total_mass_kg() - lost_kg, 1e-12);
  }
}

TEST(DamageStages, AreDrawnWithoutTheLegsThatAreMissingFromTheStartAlone) {
  const auto robot = quadruped();
  const auto gone = [&](const Part& part) {
    std::vector<std::string> legs;
    const robot::RobotSpec drawn = as_drawn(robot, {{part}});
    for (std::size_t g = 0; g < drawn.geoms.size(); ++g) {
      const int leg = robot.leg_of_body(drawn.geoms[g].body);
      if (drawn.geoms[g].rgba != robot::gone_rgba) continue;
      EXPECT_GE(leg, 0);
      if (legs.empty() || legs.back() != robot.legs[to_index(leg)].name)
        legs.push_back(robot.legs[to_index(leg)].name);
    }
    return legs;
  };
  const std::string second = robot.legs[1].name;
  Part part = missing(second);
  EXPECT_EQ(gone(part), std::vector<std::string>{second});
  part.from_s = 2.0;
  EXPECT_TRUE(gone(part).empty()) << "it is there at first";
  EXPECT_TRUE(gone(locked(robot.joints[0].name, 0.0)).empty());
}

TEST(DamageStages, LockAJointWithoutAMotorAndLeaveFeetOfSeveralShapesWhole) {
  robot::RobotSpec robot = tests::with_passive_joint(tests::legged_robot(2));
  robot::Leg& last = robot.legs.back();
  robot::Geom heel = robot.geoms[to_index(last.foot_geoms[0])];
  heel.position_m.x -= 0.05;
  robot.geoms.push_back(heel);
  last.foot_geoms.push_back(static_cast<int>(robot.geoms.size()) - 1);
  const auto stages =
      stages_of(robot, {{locked(robot.joints.back().name, 0.05), missing(robot.legs[0].name)}});
  ASSERT_EQ(stages.size(), 1u);
  const robot::RobotSpec& rest = stages[0].robot;
  expect_sound(rest);
  EXPECT_TRUE(rest.joints.back().has_motor());
  ASSERT_EQ(rest.legs.back().foot_geoms.size(), 2u);
  for (std::size_t g = 0; g < 2; ++g)
    EXPECT_EQ(rest.geoms[to_index(rest.legs.back().foot_geoms[g])].position_m,
              robot.geoms[to_index(last.foot_geoms[g])].position_m);
}

TEST(DamageStages, BeginWhenTheirPartsDoAndKeepTheEarlierOnes) {
  const auto robot = quadruped();
  const std::string knee = robot.joints[0].name, hip = robot.joints[1].name;
  const auto stages =
      stages_of(robot, {{weak(hip, 0.5, 2.0), slack(knee), weak(hip, 0.5, 1.0), numb("FR", 0.5)}});
  ASSERT_EQ(stages.size(), 3u);
  const double full_nm = robot.joints[1].servo.max_torque_nm;
  const double from_s[] = {0.0, 1.0, 2.0}, share[] = {1.0, 0.5, 0.25};
  for (std::size_t s = 0; s < 3; ++s) {
    EXPECT_EQ(stages[s].from_s, from_s[s]);
    EXPECT_EQ(stages[s].robot.joints[0].servo.max_torque_nm, 0.0);
    EXPECT_EQ(stages[s].robot.joints[1].servo.max_torque_nm, share[s] * full_nm);
  }
}

TEST(DamageStages, OfAJointThatIsLockedAndLaterSlackGiveItsOwnServoBackWithoutTorque) {
  const auto robot = quadruped();
  const std::string knee = robot.joints[0].name;
  const auto stages = stages_of(robot, {{locked(knee, -0.2), slack(knee, 1.0)}});
  ASSERT_EQ(stages.size(), 2u);
  ASSERT_EQ(stages[0].locks.size(), 1u);
  EXPECT_EQ(stages[0].locks[0].angle_rad, -0.2);
  EXPECT_EQ(stages[0].robot.joints[0].servo.max_torque_nm, lock_torque_nm);
  EXPECT_TRUE(stages[1].locks.empty());
  EXPECT_EQ(stages[1].robot.joints[0].servo.max_torque_nm, 0.0);
  EXPECT_EQ(stages[1].robot.joints[0].servo.gain_per_s, robot.joints[0].servo.gain_per_s);
}

TEST(DamageStages, ForgetLocksAndPayloadsOfALegThatIsGone) {
  const auto robot = quadruped();
  Part load = payload(1.0, 0.0, 0.0, 0.0);
  load.body = robot.bodies[to_index(robot.joints[0].body)].name;
  const Settings settings{{locked(robot.joints[0].name, -0.2), load, missing("FL")}};
  const auto stages = stages_of(robot, settings);
  EXPECT_TRUE(stages[0].locks.empty());
  const Settings only_missing{{missing("FL")}};
  EXPECT_EQ(stages[0].robot.total_mass_kg(), robot_at_start(robot, only_missing).total_mass_kg());
}

TEST(DamageStages, StartWithTheFirstStepThatBeginsAtTheirMoment) {
  EXPECT_EQ(first_step(0.0, 0.01), 1);
  EXPECT_EQ(first_step(0.01, 0.01), 2);
  EXPECT_EQ(first_step(0.011, 0.01), 3);
  for (int n = 0; n < 100000; ++n) ASSERT_EQ(first_step(n * 0.01, 0.01), n + 1);
  EXPECT_GT(first_step(1e9, 1e-5), 1000000);
}

/// Kinetic energy of a body that turns with `spin` about its own centre of mass.
double spin_energy(const robot::Body& body, Vec3 spin) {
  const Vec3 own = rotate(conjugate(body.inertia_rotation), spin);
  const Vec3 moments = body.inertia_kg_m2;
  return 0.5 * (moments.x * own.x * own.x + moments.y * own.y * own.y + moments.z * own.z * own.z);
}

TEST(Payload, OfADumbbellHasTheMomentsOfTwoPoints) {
  robot::Body body{.name = "b",
                   .position_m = {},
                   .rotation = {},
                   .mass_kg = 2.0,
                   .com_m = {1.0, 0.0, 0.0},
                   .inertia_kg_m2 = {1e-9, 1e-9, 1e-9},
                   .inertia_rotation = {}};
  add_point_mass(body, 6.0, {-1.0, 0.0, 0.0});
  EXPECT_EQ(body.mass_kg, 8.0);
  EXPECT_NEAR(body.com_m.x, -0.5, 1e-15);
  // The reduced mass 2 · 6 / 8 at the distance 2.
  std::array moments{body.inertia_kg_m2.x, body.inertia_kg_m2.y, body.inertia_kg_m2.z};
  std::ranges::sort(moments);
  EXPECT_NEAR(moments[0], 0.0, 1e-8);
  EXPECT_NEAR(moments[1], 6.0, 1e-8);
  EXPECT_NEAR(moments[2], 6.0, 1e-8);
}

TEST(Payload, HasTheEnergyOfBodyAndPointForAnySpin) {
  Stream stream(1, Purpose::trial_noise, 0, 0);
  const auto vector = [&] {
    return Vec3{stream.uniform(-1.0, 1.0), stream.uniform(-1.0, 1.0), stream.uniform(-1.0, 1.0)};
  };
  for (int i = 0; i < 2000; ++i) {
    const Vec3 axis = vector();
    const robot::Body before{
        .name = "b",
        .position_m = {},
        .rotation = {},
        .mass_kg = stream.uniform(0.1, 5.0),
        .com_m = vector(),
        .inertia_kg_m2 = {stream.uniform(0.1, 0.2), stream.uniform(0.1, 0.2), stream.uniform(0.1, 0.2)},
        .inertia_rotation = axis_angle((1.0 / norm(axis)) * axis, stream.uniform(-3.0, 3.0))};
    const double mass = stream.uniform(0.0, 5.0);
    const Vec3 at = i % 5 == 0 ? before.com_m : vector();
    robot::Body both = before;
    add_point_mass(both, mass, at);
    const Vec3 spin = vector();
    const Vec3 first = cross(spin, before.com_m - both.com_m), second = cross(spin, at - both.com_m);
    const double expected = spin_energy(before, spin) + 0.5 * before.mass_kg * dot(first, first) +
                            0.5 * mass * dot(second, second);
    ASSERT_NEAR(spin_energy(both, spin), expected, 1e-12 * (1.0 + expected)) << i;
    const Vec3 moment = before.mass_kg * before.com_m + mass * at;
    ASSERT_NEAR(norm(both.mass_kg * both.com_m - moment), 0.0, 1e-13) << i;
    const Quat q = both.inertia_rotation;
    ASSERT_NEAR(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 1.0, 1e-14) << i;
    ASSERT_GT(std::min({both.inertia_kg_m2.x, both.inertia_kg_m2.y, both.inertia_kg_m2.z}), 0.0) << i;
  }
}

}  // namespace

}  // namespace amble::damage
