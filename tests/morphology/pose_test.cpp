#include "amble/morphology/pose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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
