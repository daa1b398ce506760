#include "amble/robot/summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/morphology/files.hpp"

namespace amble::robot {
namespace {

using morphology::Files;
using morphology::load_one_leg;
using morphology::one_leg_xml;
using morphology::with;

using testing::HasSubstr;

TEST(Summary, ShowsWhatWasRead) {
  const Files files;
  const std::string text = summary(load_one_leg(files));
  EXPECT_THAT(text, HasSubstr("robot one leg: 3 bodies, 2 joints, 1 legs, 4.75 kg"));
  EXPECT_THAT(text, HasSubstr("thigh  torso   1"));
  EXPECT_THAT(
      text,
      HasSubstr("A_knee  shin   0 1 0              -0.7 to 0    -0.7 to 0    velocity, 9 /s, at most 5 N m"));
  EXPECT_THAT(text, HasSubstr("A    A_foot  0.04                A_hip, A_knee"));
  EXPECT_THAT(text, HasSubstr("shin    shin   cylinder, radius 0.04, length 0.4"));
  EXPECT_THAT(text, HasSubstr("contact: friction inf, erp 0.1, cfm 0.0001 m/s per N; self-collision off"));
  EXPECT_THAT(text, HasSubstr("gravity: 0 0 -9.8 m/s2; the robot has fallen below 0.5 m"));
}

TEST(Summary, ShowsJointsWithoutAMotorAndFeetOfSeveralShapes) {
  const Files files;
  RobotSpec robot = load_one_leg(files);
  robot.legs[0].joints[1] = -1;
  robot.legs[0].foot_geoms.push_back(2);
  Joint& knee = robot.joints[1];
  knee.servo = {.mode = ServoMode::none, .gain_per_s = 0.0, .max_torque_nm = 0.0};
  knee.command = AngleRange{};
  EXPECT_THAT(summary(robot), HasSubstr("-0.7 to 0    passive      no motor"));
  EXPECT_THAT(summary(robot), HasSubstr("A    A_foot, shin  0.04 "));
  knee.stiffness_nm_per_rad = 2.5;
  knee.rest_rad = -0.3;
  EXPECT_THAT(summary(robot), HasSubstr("no motor, a spring of 2.5 N m/rad towards -0.3 rad"));
}

TEST(Summary, ShowsTheAxesOfTurnedBodiesInTheWorld) {
  const Files files;
  const std::string text = summary(load_one_leg(
      files, with(one_leg_xml, "name=\"thigh\" pos", "name=\"thigh\" euler=\"0 0 1.5707963267948966\" pos")));
  EXPECT_THAT(text, HasSubstr("A_hip   thigh  -1 0 0"));
}

}  // namespace
}  // namespace amble::robot
