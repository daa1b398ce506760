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

TEST(Summary, ShowsTheAxesOfTurnedBodiesInTheWorld) {
  const Files files;
  const std::string text = summary(load_one_leg(
      files, with(one_leg_xml, "name=\"thigh\" pos", "name=\"thigh\" euler=\"0 0 1.5707963267948966\" pos")));
  EXPECT_THAT(text, HasSubstr("A_hip   thigh  -1 0 0"));
}

}  // namespace
}  // namespace amble::robot
