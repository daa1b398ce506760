#include "amble/morphology/pose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

constexpr double quarter = std::numbers::pi / 2;

TEST(Pose, TakesPointsAndFramesOutwards) {
  const Pose outer{{1.0, 2.0, 3.0}, axis_angle({0.0, 0.0, 1.0}, quarter)};
  const Vec3 point = outer * Vec3{1.0, 0.0, 0.0};
  EXPECT_NEAR(norm(point - Vec3{1.0, 3.0, 3.0}), 0.0, 1e-15);
  const Pose inner{{0.0, 1.0, 0.0}, axis_angle({1.0, 0.0, 0.0}, quarter)};
  EXPECT_NEAR(norm((outer * inner) * Vec3{0.3, 0.4, 0.5} - outer * (inner * Vec3{0.3, 0.4, 0.5})), 0.0,
              1e-15);
}

TEST(StartPoses, ChainTheBodies) {
  const Files files;
  const auto poses = start_poses(load_one_leg(files));
  ASSERT_EQ(poses.size(), 3u);
  EXPECT_EQ(poses[0].position_m, (Vec3{0.0, 0.0, 1.0}));
  EXPECT_NEAR(poses[2].position_m.z, 0.5, 1e-15);
}

TEST(PosesAt, AreTheStartPosesWhenNothingIsTurned) {
  const Files files;
  const auto robot = load_one_leg(files);
  const auto start = start_poses(robot);
  const auto poses = poses_at(robot, start[0], std::vector<double>(robot.joints.size()));
  for (std::size_t b = 0; b < poses.size(); ++b)
    EXPECT_NEAR(norm(poses[b].position_m - start[b].position_m), 0.0, 1e-15);
}

TEST(PosesAt, TurnABodyAboutTheAnchorOfItsJoint) {
  RobotSpec robot;
  robot.bodies.resize(2);
  robot.bodies[1].parent = 0;
  robot.bodies[1].position_m = {0.0, 0.0, -1.0};
  robot.joints.resize(1);
  robot.joints[0].body = 1;
  robot.joints[0].axis = {0.0, 1.0, 0.0};
  robot.joints[0].anchor_m = {0.0, 0.0, 1.0};  // where the root's frame stands
  const double turned[]{quarter};
  const auto poses = poses_at(robot, {{5.0, 0.0, 2.0}, {}}, turned);
  EXPECT_NEAR(norm(poses[1].position_m - Vec3{4.0, 0.0, 2.0}), 0.0, 1e-15) << "down turns to back about +y";
  EXPECT_NEAR(norm(poses[1] * robot.joints[0].anchor_m - Vec3{5.0, 0.0, 2.0}), 0.0, 1e-15);
}

TEST(Clearance, IsThatOfTheLowestGeomThatCollides) {
  RobotSpec robot;
  robot.bodies.resize(1);
  const std::vector<Pose> poses{{{0.0, 0.0, 2.0}, {}}};
  EXPECT_EQ(clearance_m(robot, poses), std::numeric_limits<double>::infinity());
  robot.geoms.resize(3);
  for (Geom& geom : robot.geoms) geom.size_m = {0.1, 0.0, 0.0};
  robot.geoms[1].position_m.z = -0.5;
  robot.geoms[2].position_m.z = -1.5;
  robot.geoms[2].collides = false;
  EXPECT_NEAR(clearance_m(robot, poses), 1.4, 1e-15);
}

TEST(StartClearance, IsTheHeightOfTheLowestPointOfEachShape) {
  RobotSpec robot;
  robot.bodies.resize(1);
  robot.bodies[0].position_m = {0.0, 0.0, 2.0};
  robot.geoms.resize(1);
  Geom& geom = robot.geoms[0];
  geom.size_m = {0.1, 0.3, 0.5};
  const double tilt = 0.4;
  geom.rotation = axis_angle({1.0, 0.0, 0.0}, tilt);
  geom.position_m = {7.0, 0.0, 0.25};
  geom.shape = Shape::sphere;
  EXPECT_NEAR(start_clearance_m(robot, 0), 2.25 - 0.1, 1e-15);
  geom.shape = Shape::capsule;
  EXPECT_NEAR(start_clearance_m(robot, 0), 2.25 - 0.1 - 0.3 * std::cos(tilt), 1e-15);
  geom.shape = Shape::cylinder;
  EXPECT_NEAR(start_clearance_m(robot, 0), 2.25 - 0.1 * std::sin(tilt) - 0.3 * std::cos(tilt), 1e-15);
  geom.shape = Shape::box;
  EXPECT_NEAR(start_clearance_m(robot, 0), 2.25 - 0.3 * std::sin(tilt) - 0.5 * std::cos(tilt), 1e-15);
}

}  // namespace
}  // namespace amble::morphology
