#include "amble/robot/legs.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "amble/core/random.hpp"
#include "amble/robot/check.hpp"
#include "tests/robot/legged.hpp"

namespace amble::robot {
namespace {

std::vector<std::pair<int, int>> pairs_of(const std::vector<Vec3>& places_m) {
  std::vector<std::pair<int, int>> pairs;
  for (const LegPair& pair : leg_pairs(places_m)) pairs.emplace_back(pair.left, pair.right);
  return pairs;
}

using Pairs = std::vector<std::pair<int, int>>;

TEST(LegPairs, AreLeftAndRightFromFrontToBack) {
  EXPECT_EQ(pairs_of({{0, 1, 0}, {0, -1, 0}}), (Pairs{{0, 1}}));
  EXPECT_EQ(pairs_of({{-1, -1, 0}, {2, -1, 0}, {-1, 1, 0}, {2, 1, 0}}), (Pairs{{3, 1}, {2, 0}}));
  // Staggered sides: the n-th of one belongs to the n-th of the other.
  EXPECT_EQ(pairs_of({{0.1, 1, 0}, {0, -1, 0}, {1.1, 1, 0}, {1, -1, 0}}), (Pairs{{2, 3}, {0, 1}}));
}

TEST(LegPairs, OfLegsRoundACircleNeedAGapBetweenTheSides) {
  const auto circle = [](int legs, double first_rad) {
    std::vector<Vec3> places_m;
    for (int leg = 0; leg < legs; ++leg) {
      const double angle_rad = first_rad + 2.0 * std::acos(-1.0) * leg / legs;
      places_m.push_back({std::cos(angle_rad), std::sin(angle_rad), 0});
    }
    return places_m;
  };
  EXPECT_EQ(pairs_of(circle(6, std::acos(-1.0) / 6)), (Pairs{{0, 5}, {1, 4}, {2, 3}}));
  EXPECT_TRUE(pairs_of(circle(6, 0.0)).empty()) << "one leg in front, one behind";
}

TEST(LegPairs, AreNoneWhereLeftAndRightCannotBeTold) {
  EXPECT_TRUE(pairs_of({}).empty());
  EXPECT_TRUE(pairs_of({{0, 1, 0}}).empty());
  EXPECT_TRUE(pairs_of({{0, 1, 0}, {1, -1, 0}, {2, 1, 0}}).empty());
  EXPECT_TRUE(pairs_of({{1, 0, 0}, {0, 0, 0}}).empty()) << "one behind the other";
  EXPECT_TRUE(pairs_of({{0, 2, 0}, {0, 1, 0}, {0, -1, 0}, {0, -2, 0}}).empty()) << "all abreast";
}

TEST(LegPairs, AreNoneWhereOnlyRoundingTellsTwoLegsOfASideApart) {
  const auto with_second_at = [](double x_m) {
    return pairs_of({{0, 1, 0}, {0, -1, 0}, {x_m, 1, 0}, {1, -1, 0}});
  };
  for (const double rounding_m : {0.0, 1e-12, -1e-12, 5e-7, -5e-7})
    EXPECT_TRUE(with_second_at(rounding_m).empty()) << rounding_m;
  EXPECT_EQ(with_second_at(1e-5), (Pairs{{2, 3}, {0, 1}}));
  EXPECT_EQ(with_second_at(-1e-5), (Pairs{{0, 3}, {2, 1}}));
}

TEST(LegPairs, OfAnOddNumberOfLegsAreNone) {
  Stream stream(1, Purpose::test);
  for (int round = 0; round < 200; ++round) {
    std::vector<Vec3> places_m(1 + 2 * stream.below(5));
    for (Vec3& place_m : places_m) place_m = {stream.uniform(-1.0, 1.0), stream.uniform(-1.0, 1.0), 0.0};
    EXPECT_TRUE(pairs_of(places_m).empty()) << places_m.size();
    places_m.back().y = -9.0;
    EXPECT_TRUE(pairs_of(places_m).empty()) << "one leg far to the right";
  }
}

TEST(LegPairs, OfARobotAreFoundByItsHipsAndByItsFeet) {
  const RobotSpec robot = tests::legged_robot(3);
  const auto poses = start_poses(robot);
  for (const auto& places_m : {hips_m(robot, poses), feet_m(robot, poses)})
    EXPECT_EQ(pairs_of(places_m), (Pairs{{0, 1}, {2, 3}, {4, 5}}));
  EXPECT_NEAR(hips_m(robot, poses)[0].z, 0.55, 1e-12);
  EXPECT_NEAR(feet_m(robot, poses)[0].z, 0.05, 1e-12);
  for (std::size_t leg = 0; leg < 6; ++leg)
    EXPECT_EQ(hip_joint(robot, robot.legs[leg]), robot.legs[leg].joints[2]) << "hip_io, next to the torso";
}

TEST(LeggedRobot, PassesTheChecksOfRobots) {
  for (const int rows : {1, 2, 3})
    for (const RobotSpec& robot :
         {tests::legged_robot(rows), tests::without_hip_io(tests::legged_robot(rows), 1),
          tests::with_held_joint(tests::legged_robot(rows), 0, 0)})
      check_robot(robot, [](const std::string& problem) { ADD_FAILURE() << problem; });
}

TEST(HipJoint, IsTheOneNextToTheTorsoWhicheverJointsTheLegHas) {
  // The first hinge of the upper leg belongs to no leg: the hip is the second one, not the knee, though that
  // is the first of its body.
  RobotSpec robot = tests::legged_robot(1);
  Leg& leg = robot.legs[0];
  leg.joints[2] = -1;
  EXPECT_EQ(hip_joint(robot, leg), leg.joints[1]);
  leg.joints[1] = -1;
  EXPECT_EQ(hip_joint(robot, leg), leg.joints[0]);
  leg.joints[0] = -1;
  EXPECT_EQ(hip_joint(robot, leg), -1);
}

TEST(LegHeight, IsThatOfTheHipsOverTheFeetInTheStartPose) {
  RobotSpec robot = tests::legged_robot(2);
  const double height_m = leg_height_m(robot);
  const auto poses = start_poses(robot);
  EXPECT_NEAR(height_m,
              hips_m(robot, poses)[0].z - bottom_m(robot.geoms[to_index(robot.legs[0].foot_geoms[0])], poses),
              1e-12);
  robot.bodies[0].position_m.z += 0.3;
  EXPECT_NEAR(leg_height_m(robot), height_m, 1e-12) << "wherever the ground is";
  robot.legs.clear();
  EXPECT_EQ(leg_height_m(robot), 0.0);
}

TEST(Foot, OfSeveralShapesIsAtTheirMeanAndReachesAsLowAsTheLowest) {
  RobotSpec robot = tests::legged_robot(1);
  const auto poses = start_poses(robot);
  const Vec3 ball_m = foot_m(robot, robot.legs[0], poses);
  const double bottom_m = foot_bottom_m(robot, robot.legs[0], poses), height_m = leg_height_m(robot);
  Geom heel = robot.geoms[to_index(robot.legs[0].foot_geoms[0])];
  heel.position_m = heel.position_m + Vec3{-0.08, 0.0, -0.02};
  robot.geoms.push_back(heel);
  robot.legs[0].foot_geoms.push_back(static_cast<int>(robot.geoms.size()) - 1);
  EXPECT_NEAR(norm(foot_m(robot, robot.legs[0], poses) - ball_m - Vec3{-0.04, 0.0, -0.01}), 0.0, 1e-12);
  EXPECT_NEAR(foot_bottom_m(robot, robot.legs[0], poses), bottom_m - 0.02, 1e-12);
  EXPECT_NEAR(leg_height_m(robot), height_m + 0.5 * 0.02, 1e-12);
}

TEST(LegPairs, CallPlacesTheSameUpToAMicrometre) {
  const auto side_by_side = [](double y_m) { return pairs_of({{0, y_m, 0}, {0, 0, 0}}).size(); };
  EXPECT_EQ(side_by_side(0.9e-6), 0u);
  EXPECT_EQ(side_by_side(1.1e-6), 1u);
  const auto rows = [](double left_m, double right_m) {
    return pairs_of({{left_m, 1, 0}, {0, 1, 0}, {right_m, -1, 0}, {0, -1, 0}}).size();
  };
  EXPECT_EQ(rows(1.1e-6, 1.1e-6), 2u);
  EXPECT_EQ(rows(0.9e-6, 1.1e-6), 0u) << "on the left";
  EXPECT_EQ(rows(1.1e-6, 0.9e-6), 0u) << "on the right";
}

}  // namespace
}  // namespace amble::robot
