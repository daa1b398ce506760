#include "amble/robot/leg_doubts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amble/robot/doubts.hpp"
#include "amble/robot/legs.hpp"
#include "tests/robot/legged.hpp"

namespace amble::robot {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A quadruped with legs of that length, that mass and 12 such motors.
RobotSpec quadruped(double leg_m, double mass_kg, double torque_nm) {
  RobotSpec robot = tests::legged_robot(2);
  const double scale = leg_m / longest_leg_m(robot), by_mass = mass_kg / robot.total_mass_kg();
  for (Body& body : robot.bodies) {
    body.position_m = scale * body.position_m;
    body.mass_kg *= by_mass;
  }
  for (Geom& geom : robot.geoms) geom.position_m = scale * geom.position_m;
  for (Joint& joint : robot.joints) joint.servo.max_torque_nm = torque_nm;
  return robot;
}

std::vector<std::string> strength(const RobotSpec& robot) {
  std::vector<std::string> lines;
  doubt_strength(robot, lines);
  return lines;
}

std::vector<std::string> axes(const RobotSpec& robot) {
  std::vector<std::string> lines;
  doubt_axes(robot, lines);
  return lines;
}

TEST(LegLength, IsThatOfTheStretchedLeg) {
  RobotSpec robot = tests::legged_robot(2);
  EXPECT_DOUBLE_EQ(longest_leg_m(robot), 0.5);
  robot.geoms[to_index(robot.legs[3].foot_geoms[0])].position_m.z = -0.35;
  EXPECT_DOUBLE_EQ(longest_leg_m(robot), 0.6);
  robot.legs.clear();
  EXPECT_EQ(longest_leg_m(robot), 0.0);
}

TEST(Strength, InKgCmIsDoubtedOnSmallRobotsAndNotInNewtonMetres) {
  // A cat, one of a hobby, one with strong servos.
  const struct {
    double leg_m, mass_kg, kg_cm;
  } robots[] = {{0.1, 0.3, 3.0}, {0.2, 1.4, 15.0}, {0.25, 2.7, 35.0}};
  for (const auto& [leg_m, mass_kg, kg_cm] : robots) {
    EXPECT_THAT(strength(quadruped(leg_m, mass_kg, kg_cm)),
                ElementsAre(AllOf(HasSubstr("L1_knee ("), HasSubstr("kg·cm"), HasSubstr("× 0.098"))))
        << mass_kg;
    EXPECT_THAT(strength(quadruped(leg_m, mass_kg, nm_per_kg_cm * kg_cm)), IsEmpty()) << mass_kg;
  }
  EXPECT_THAT(strength(quadruped(0.2, 1.4, 15.0)).at(0), HasSubstr("makes 1.47 N m of 15"));
}

TEST(Strength, OfRobotsThatExistIsNotDoubted) {
  // Leg, mass, torque as their URDFs have them: A1, Go2's knee, Mini Cheetah, Solo 12, ANYmal, HyQ, Spot's
  // knee.
  EXPECT_THAT(strength(quadruped(0.4, 12.0, 33.5)), IsEmpty());
  EXPECT_THAT(strength(quadruped(0.43, 15.0, 45.4)), IsEmpty());
  EXPECT_THAT(strength(quadruped(0.4, 9.0, 17.0)), IsEmpty());
  EXPECT_THAT(strength(quadruped(0.32, 2.5, 2.7)), IsEmpty());
  EXPECT_THAT(strength(quadruped(0.6, 30.0, 80.0)), IsEmpty());
  EXPECT_THAT(strength(quadruped(0.75, 80.0, 200.0)), IsEmpty());
  EXPECT_THAT(strength(quadruped(0.7, 32.0, 115.0)), IsEmpty());
}

TEST(Strength, IsDoubtedWhereBothMeasuresAreExceeded) {
  // 10 kg on legs of 0.5 m: 8 × 12.25 N m; 250 N m in sum are 20.8 each.
  EXPECT_THAT(strength(quadruped(0.5, 10.0, 97.0)), IsEmpty());
  EXPECT_THAT(strength(quadruped(0.5, 10.0, 99.0)), testing::SizeIs(1));
  // On legs of 0.1 m 8 × 2.45 N m are less than the motors that it could carry.
  EXPECT_THAT(strength(quadruped(0.1, 10.0, 20.5)), IsEmpty());
  EXPECT_THAT(strength(quadruped(0.1, 10.0, 21.5)), testing::SizeIs(1));
}

TEST(Strength, OfTorqueServosAndOfRobotsWithoutLegsIsNotDoubted) {
  RobotSpec robot = quadruped(0.2, 1.4, 150.0);
  for (Joint& joint : robot.joints) joint.servo.mode = ServoMode::torque;
  EXPECT_THAT(strength(robot), IsEmpty());
  robot = quadruped(0.2, 1.4, 150.0);
  robot.legs.clear();
  EXPECT_THAT(strength(robot), IsEmpty());
}

TEST(Axes, AlongTheLegAreNamedWhereNothingBeyondBendsIt) {
  RobotSpec robot = tests::legged_robot(2);
  EXPECT_THAT(axes(robot), IsEmpty());
  robot.joints[0].axis = robot.joints[1].axis = {0.0, 0.0, 1.0};
  ASSERT_EQ(robot.joints[1].name, "L1_hip_fb");
  EXPECT_THAT(axes(robot),
              ElementsAre(AllOf(HasSubstr("L1_knee (0 0 1), L1_hip_fb (0 0 1), axes in the world"),
                                Not(HasSubstr("L1_hip_io")), Not(HasSubstr("R1")))));
  EXPECT_THAT(doubts(robot), testing::Contains(axes(robot)[0]));
}

TEST(Axes, AlongAStraightLegAreFineWhereAKneeBendsIt) {
  // Hips that turn about the vertical, as those of bipeds.
  RobotSpec robot = tests::legged_robot(2);
  for (Joint& joint : robot.joints)
    if (joint.name.ends_with("hip_io")) joint.axis = {0.0, 0.0, 1.0};
  EXPECT_THAT(axes(robot), IsEmpty());
  // But not if the knee hardly bends and the other hip joint spins, too.
  for (Joint& joint : robot.joints) {
    if (joint.name.ends_with("knee")) joint.upper_rad = 0.01;
    if (joint.name.ends_with("hip_fb")) joint.axis = {0.0, 0.0, -1.0};
  }
  EXPECT_THAT(axes(robot),
              ElementsAre(AllOf(HasSubstr("L1_hip_io"), HasSubstr("R1_hip_fb"), HasSubstr("and 4 more"))));
}

TEST(Axes, OfAnkleAndWheelMayPassThroughTheFoot) {
  for (const Vec3 axis : {Vec3{0.0, 1.0, 0.0}, Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 0.0, 1.0}}) {
    RobotSpec robot = tests::legged_robot(2);
    for (const Leg& leg : robot.legs) {
      Joint& ankle = robot.joints[to_index(leg.joints[0])];
      ankle.axis = axis;
      ankle.anchor_m = {0.0, 0.0, -0.2};
    }
    EXPECT_THAT(axes(robot), IsEmpty());
  }
}

}  // namespace
}  // namespace amble::robot
