#include "amble/gait/body.hpp"

#include <gtest/gtest.h>

#include "amble/robot/pose.hpp"
#include "tests/motion/fixture.hpp"
#include "tests/robot/legged.hpp"

namespace amble::gait {
namespace {

TEST(GaitBody, IsReadOffTheRobot) {
  // The fixture's robot: 1 kg and four lower legs of 0.1 kg; its hips are 1 m above the ground.
  const Body body = body_of(tests::robot());
  EXPECT_EQ(body.legs, (std::vector<std::string>{"FL", "FR", "BL", "BR"}));
  EXPECT_EQ(body.joints.size(), 12u);
  EXPECT_NEAR(body.mass_kg, 1.4, 1e-12);
  EXPECT_NEAR(body.gravity_m_s2, 9.8, 1e-12);
  EXPECT_NEAR(body.leg_length_m, 1.0, 1e-12);
}

TEST(GaitBody, MeasuresTheLegsOfARobotThatHangsInTheAirAsIfItStood) {
  robot::RobotSpec robot = tests::robot();
  const double bottom_m = robot::bottom_m(robot.geoms[static_cast<std::size_t>(robot.legs[0].foot_geoms[0])],
                                          robot::start_poses(robot));
  robot.bodies[0].position_m.z -= bottom_m;
  const double standing_m = body_of(robot).leg_length_m;
  robot.bodies[0].position_m.z += 0.25;
  EXPECT_NEAR(body_of(robot).leg_length_m, standing_m, 1e-12);
}

TEST(GaitBody, FindsTheLegsByThePositionsOfTheFeetWhateverTheirNames) {
  robot::RobotSpec robot = tests::robot();
  std::swap(robot.legs[0], robot.legs[3]);
  std::swap(robot.legs[1], robot.legs[3]);
  const auto legs = body_of(robot).quadruped.value();  // now BR, FL, BL, FR
  EXPECT_EQ(robot.legs[static_cast<std::size_t>(legs.fore_left)].name, "FL");
  EXPECT_EQ(robot.legs[static_cast<std::size_t>(legs.fore_right)].name, "FR");
  EXPECT_EQ(robot.legs[static_cast<std::size_t>(legs.hind_left)].name, "BL");
  EXPECT_EQ(robot.legs[static_cast<std::size_t>(legs.hind_right)].name, "BR");
}

TEST(GaitBody, IsAQuadrupedOnlyWithTwoLegsBehindTwo) {
  EXPECT_TRUE(body_of(tests::robot(4)).quadruped);
  EXPECT_FALSE(body_of(tests::robot(2)).quadruped);
  EXPECT_FALSE(body_of(tests::robot(6)).quadruped);
  robot::RobotSpec cross = tests::robot(4);  // one in front, one behind, two at the sides
  const double places[4][2] = {{0.5, 0.0}, {0.0, 0.3}, {0.0, -0.3}, {-0.5, 0.0}};
  for (std::size_t leg = 0; leg < 4; ++leg) {
    robot::Body& upper = cross.bodies[1 + 2 * leg];
    upper.position_m = {places[leg][0], places[leg][1], 0.0};
  }
  EXPECT_FALSE(body_of(cross).quadruped);
}

TEST(GaitBody, HasPairsOfTwoAndSixLegsFromFrontToBack) {
  for (const int rows : {1, 3}) {
    const auto pairs = body_of(tests::legged_robot(rows)).pairs;
    ASSERT_EQ(pairs.size(), static_cast<std::size_t>(rows));
    for (int row = 0; row < rows; ++row) {
      EXPECT_EQ(pairs[static_cast<std::size_t>(row)].left, 2 * row);
      EXPECT_EQ(pairs[static_cast<std::size_t>(row)].right, 2 * row + 1);
    }
  }
  for (const int rows : {2, 4}) EXPECT_TRUE(body_of(tests::legged_robot(rows)).pairs.empty());
}

}  // namespace
}  // namespace amble::gait
