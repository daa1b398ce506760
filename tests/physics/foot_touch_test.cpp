#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "amble/core/index.hpp"
#include "amble/robot/legs.hpp"
#include "tests/physics/scene.hpp"
#include "tests/robot/legged.hpp"

namespace amble::physics {
namespace {

class FootOfSeveralShapes : public OnEachEngine {};
ON_EACH_ENGINE(FootOfSeveralShapes);

/// Feet of these shapes at the corners of a square in place of the balls.
robot::RobotSpec on_corners(const std::array<robot::Shape, 4>& shapes, int first_corner = 0) {
  robot::RobotSpec robot = tests::legged_robot(2);
  for (robot::Leg& leg : robot.legs) {
    const robot::Geom ball = robot.geoms[to_index(leg.foot_geoms[0])];
    robot.geoms[to_index(leg.foot_geoms[0])].collides = false;
    leg.foot_geoms.clear();
    for (int k = 0; k < 4; ++k) {
      const int corner = (k + first_corner) % 4;
      robot::Geom geom = ball;
      geom.shape = shapes[to_index(corner)];
      geom.size_m = {0.02, 0.01, 0.015};
      geom.position_m =
          geom.position_m + Vec3{corner < 2 ? 0.05 : -0.05, corner % 2 == 0 ? 0.04 : -0.04, 0.0};
      leg.foot_geoms.push_back(static_cast<int>(robot.geoms.size()));
      robot.geoms.push_back(geom);
    }
  }
  return robot;
}

/// The robot turned such that this corner of its feet is the lowest, and that of the first leg `gap_m` over
/// the ground, while all of its other corners are higher by centimetres.
StartPose on_a_corner(const robot::RobotSpec& robot, int shape, double gap_m) {
  const Vec3 corner = robot.geoms[to_index(shape)].position_m;
  const Quat pitch = axis_angle({0, 1, 0}, corner.x > 0.0 ? 0.3 : -0.3),
             roll = axis_angle({1, 0, 0}, corner.y > 0.0 ? -0.3 : 0.3);
  StartPose pose{{{0, 0, 2.0}, pitch * roll}, std::vector<double>(robot.joints.size(), 0.0)};
  const auto bodies =
      robot::poses_at(robot, {pose.root.position_m, pose.root.rotation}, pose.joint_angle_rad);
  pose.root.position_m.z -= robot::bottom_m(robot.geoms[to_index(shape)], bodies) - gap_m;
  return pose;
}

TEST_P(FootOfSeveralShapes, IsInTouchWhileAnyOfThemTouches) {
  using robot::Shape;
  const std::array all{std::array{Shape::sphere, Shape::sphere, Shape::sphere, Shape::sphere},
                       std::array{Shape::box, Shape::capsule, Shape::sphere, Shape::cylinder}};
  for (const auto& shapes : all)
    for (const int first : {0, 2}) {
      const robot::RobotSpec robot = on_corners(shapes, first);
      Bench bench(GetParam(), robot);
      for (const int shape : robot.legs[0].foot_geoms) {
        const int only = shape - robot.legs[0].foot_geoms[0];
        bench.engine->place_at(0, on_a_corner(robot, shape, -0.002));
        EXPECT_TRUE(bench.touches(0)) << first << " " << only;
        bench.engine->step(bench.targets);
        EXPECT_TRUE(bench.touches(0)) << first << " " << only << " in a step";
        bench.engine->place_at(0, on_a_corner(robot, shape, 0.002));
        EXPECT_FALSE(bench.touches(0)) << first << " " << only;
        bench.engine->step(bench.targets);
        EXPECT_FALSE(bench.touches(0)) << first << " " << only << " in a step";
      }
    }
}

TEST_P(FootOfSeveralShapes, IsNotTouchedByShapesThatAreNotItsOwn) {
  robot::RobotSpec robot =
      on_corners({robot::Shape::sphere, robot::Shape::sphere, robot::Shape::sphere, robot::Shape::sphere});
  const int front = robot.legs[0].foot_geoms[0], rear = robot.legs[0].foot_geoms[3];
  robot.legs[0].foot_geoms = {rear};
  Bench bench(GetParam(), robot);
  bench.engine->place_at(0, on_a_corner(robot, front, -0.002));
  EXPECT_FALSE(bench.touches(0));
  bench.engine->place_at(0, on_a_corner(robot, rear, -0.002));
  EXPECT_TRUE(bench.touches(0));
}

TEST_P(FootOfSeveralShapes, ListedInAnyOrderMovesTheSame) {
  const std::array shapes{robot::Shape::sphere, robot::Shape::sphere, robot::Shape::sphere,
                          robot::Shape::sphere};
  robot::RobotSpec one = on_corners(shapes), other = one;
  for (robot::Leg& leg : other.legs) std::ranges::reverse(leg.foot_geoms);
  Bench first(GetParam(), one), second(GetParam(), other);
  int touches = 0;
  for (int n = 0; n < 100; ++n) {
    first.steps(1);
    second.steps(1);
    ASSERT_EQ(first.engine->state_hash(0), second.engine->state_hash(0)) << n;
    for (int leg = 0; leg < 4; ++leg) ASSERT_EQ(first.touches(leg), second.touches(leg)) << n;
    touches += first.touches(0) ? 1 : 0;
  }
  EXPECT_GT(touches, 10);
}

}  // namespace
}  // namespace amble::physics
