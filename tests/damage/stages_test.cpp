#include "amble/damage/stages.hpp"

#include <gtest/gtest.h>

#include "amble/core/index.hpp"
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

}  // namespace
}  // namespace amble::damage
