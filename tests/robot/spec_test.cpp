#include "amble/robot/spec.hpp"

#include <gtest/gtest.h>

#include "tests/morphology/files.hpp"

namespace amble::robot {
namespace {

using morphology::Files;
using morphology::load_one_leg;

TEST(RobotSpec, SumsTheMassesOfItsBodies) {
  const Files files;
  EXPECT_DOUBLE_EQ(load_one_leg(files).total_mass_kg(), 4.75);
}

TEST(RobotSpec, NamesTheJointsOfABodyInTheOrderOfTheChain) {
  RobotSpec robot;
  robot.joints.resize(4);
  for (int j = 0; j < 4; ++j) robot.joints[static_cast<std::size_t>(j)].body = j == 0 ? 1 : 2;
  robot.joints[1].chain_index = 2;
  robot.joints[2].chain_index = 0;
  robot.joints[3].chain_index = 1;
  EXPECT_EQ(robot.joints_of_body(1), std::vector<int>{0});
  EXPECT_EQ(robot.joints_of_body(2), (std::vector<int>{2, 3, 1}));
  EXPECT_TRUE(robot.joints_of_body(0).empty());
}

TEST(RobotSpec, ABodyThatHangsOnALegBelongsToIt) {
  const Files files;
  RobotSpec robot = load_one_leg(files);
  EXPECT_EQ(robot.leg_of_body(0), -1);
  const int shank = robot.joints.back().body;
  EXPECT_EQ(robot.leg_of_body(shank), 0);
  robot.bodies.push_back(robot.bodies.back());
  robot.bodies.back().parent = shank;
  EXPECT_EQ(robot.leg_of_body(static_cast<int>(robot.bodies.size()) - 1), 0);
}

}  // namespace
}  // namespace amble::robot
