#include "amble/morphology/robot_spec.hpp"

#include <gtest/gtest.h>

#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

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

}  // namespace
}  // namespace amble::morphology
