#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "amble/core/random.hpp"
#include "amble/robot/sensors.hpp"
#include "tests/physics/scene.hpp"

namespace amble::physics {
namespace {

class PlaceAt : public OnEachEngine {
 protected:
  double rounding_m() const { return single_precision() ? 1e-6 : 1e-12; }
};
ON_EACH_ENGINE(PlaceAt);

/// A pose in the air, tilted, with every joint somewhere within its stops.
StartPose some_pose(const robot::RobotSpec& robot, std::uint32_t which) {
  Stream stream(3, Purpose::test, which);
  StartPose pose{.root = {.position_m = {0.4, -0.3, 3.0},
                          .rotation = axis_angle({0.6, 0.0, 0.8}, stream.uniform(-0.5, 0.5))},
                 .joint_angle_rad = {}};
  for (const auto& joint : robot.joints)
    pose.joint_angle_rad.push_back(stream.uniform(joint.lower_rad, joint.upper_rad));
  return pose;
}

TEST_P(PlaceAt, PutsRootJointsAndSensorsWhereTheyWereAskedToBe) {
  Bench bench(GetParam(), quadruped());
  for (std::uint32_t which = 0; which < 50; ++which) {
    const StartPose pose = some_pose(bench.robot, which);
    bench.engine->place_at(0, pose);
    ASSERT_NEAR(norm(bench.engine->root_pose(0).position_m - pose.root.position_m), 0.0, rounding_m());
    const auto attitude = roll_pitch_yaw(pose.root.rotation);
    EXPECT_NEAR(static_cast<double>(bench.engine->sensors().attitude_rad.at(0, 0)), attitude.roll_rad, 1e-6);
    EXPECT_NEAR(static_cast<double>(bench.engine->sensors().attitude_rad.at(1, 0)), attitude.pitch_rad, 1e-6);
    for (int j = 0; j < 12; ++j)
      ASSERT_NEAR(bench.angle(j), pose.joint_angle_rad[static_cast<std::size_t>(j)], 1e-6)
          << which << ' ' << j;
    for (int leg = 0; leg < 4; ++leg) EXPECT_FALSE(bench.touches(leg));
  }
}

TEST_P(PlaceAt, SensesAttitudeFromTheStartPoseWhicheverWayTheRootsAxesPointInIt) {
  robot::RobotSpec robot = quadruped();
  const Quat own = axis_angle({0.48, -0.6, 0.64}, 1.3);
  for (const bool on_a_slope : {false, true}) {
    robot.bodies[0].rotation = own;
    if (on_a_slope) robot.gravity_m_s2 = {-1.2, 0.7, -9.7};
    Bench bench(GetParam(), robot);
    const Quat level = robot::horizontal_frame(robot.gravity_m_s2);
    for (std::uint32_t which = 0; which < 10; ++which) {
      StartPose pose = some_pose(robot, which);
      const auto attitude = roll_pitch_yaw(conjugate(level) * pose.root.rotation);
      pose.root.rotation = pose.root.rotation * own;
      bench.engine->place_at(0, pose);
      const LaneArray& sensed_rad = bench.engine->sensors().attitude_rad;
      EXPECT_NEAR(static_cast<double>(sensed_rad.at(0, 0)), attitude.roll_rad, 1e-6);
      EXPECT_NEAR(static_cast<double>(sensed_rad.at(1, 0)), attitude.pitch_rad, 1e-6);
      EXPECT_NEAR(static_cast<double>(sensed_rad.at(2, 0)), attitude.yaw_rad, 1e-6);
    }
  }
}

TEST_P(PlaceAt, PutsEveryBodyWhereKinematicsSay) {
  Bench bench(GetParam(), quadruped());
  for (std::uint32_t which = 0; which < 50; ++which) {
    const StartPose pose = some_pose(bench.robot, which);
    bench.engine->place_at(0, pose);
    const auto bodies = kinematics(bench.robot, pose.root, pose.joint_angle_rad);
    Vec3 sum;
    for (std::size_t b = 0; b < bodies.size(); ++b)
      sum = sum + bench.robot.bodies[b].mass_kg * (bodies[b] * bench.robot.bodies[b].com_m);
    EXPECT_NEAR(norm((1.0 / bench.robot.total_mass_kg()) * sum - bench.engine->com_m(0)), 0.0, rounding_m());
  }
}

TEST_P(PlaceAt, StartsAtRestWithItsJointsWhole) {
  // Were a joint torn, the engine would pull its bodies together and the robot would start to move.
  Bench bench(GetParam(), weightless(quadruped()));
  const StartPose pose = some_pose(bench.robot, 1);
  bench.engine->place_at(0, pose);
  EXPECT_EQ(norm(bench.engine->momentum_kg_m_s(0)), 0.0);
  for (int j = 0; j < 12; ++j) bench.targets.at(j, 0) = bench.engine->sensors().joint_angle_rad.at(j, 0);
  bench.steps(100);
  for (int j = 0; j < 12; ++j)
    EXPECT_NEAR(bench.angle(j), pose.joint_angle_rad[static_cast<std::size_t>(j)], 1e-6);
  EXPECT_NEAR(norm(bench.engine->root_pose(0).position_m - pose.root.position_m), 0.0, 1e-6);
}

TEST_P(PlaceAt, FindsTheFeetOnTheGroundOrNot) {
  Bench bench(GetParam(), quadruped());
  StartPose pose{.root = {bench.robot.bodies[0].position_m, {}},
                 .joint_angle_rad = std::vector<double>(12, 0.0)};
  pose.root.position_m.z -= 1e-4;
  bench.engine->place_at(0, pose);
  for (int leg = 0; leg < 4; ++leg) EXPECT_TRUE(bench.touches(leg));
  // A negative pitch lifts the nose.
  pose.root.rotation = axis_angle({0.0, 1.0, 0.0}, -0.05);
  bench.engine->place_at(0, pose);
  for (int leg = 0; leg < 4; ++leg) EXPECT_EQ(bench.touches(leg), leg >= 2) << leg;
}

TEST_P(PlaceAt, FindsAFootOfAnyShapeAndTiltOnTheGroundWhereItsLowestPointIsNotAboveIt) {
  Stream stream(5, Purpose::test);
  for (const robot::Shape shape : {robot::Shape::sphere, robot::Shape::capsule, robot::Shape::box,
                                   robot::Shape::cylinder, robot::Shape::mesh}) {
    robot::RobotSpec robot = quadruped();
    for (const robot::Leg& leg : robot.legs) {
      robot::Geom& foot = robot.geoms[static_cast<std::size_t>(leg.foot_geoms[0])];
      foot.shape = shape;
      foot.size_m = {0.05, 0.06, 0.02};
      foot.rotation = axis_angle({0.0, 0.6, 0.8}, 0.7);
      if (shape == robot::Shape::mesh) become_pyramid(foot);
    }
    Bench bench(GetParam(), robot);
    for (int n = 0; n < 300; ++n) {
      const double z = stream.uniform(-1.0, 1.0), turn = stream.uniform(0.0, 2.0 * std::numbers::pi);
      const Vec3 axis{std::sqrt(1.0 - z * z) * std::cos(turn), std::sqrt(1.0 - z * z) * std::sin(turn), z};
      StartPose pose{.root = {{}, axis_angle(axis, stream.uniform(-3.0, 3.0))}, .joint_angle_rad = {}};
      for (const auto& joint : robot.joints)
        pose.joint_angle_rad.push_back(stream.uniform(joint.lower_rad, joint.upper_rad));
      const auto poses =
          robot::poses_at(robot, {pose.root.position_m, pose.root.rotation}, pose.joint_angle_rad);
      const auto foot = static_cast<std::size_t>(robot.legs[static_cast<std::size_t>(n % 4)].foot_geoms[0]);
      for (const double above_m : {-1e-4, 1e-4, 0.3}) {
        pose.root.position_m.z = above_m - robot::bottom_m(robot.geoms[foot], poses);
        bench.engine->place_at(0, pose);
        ASSERT_EQ(bench.touches(n % 4), above_m < 0.0) << "shape " << static_cast<int>(shape) << ", " << n;
      }
    }
  }
}

TEST_P(PlaceAt, LeavesNothingBehindForTheNextTrial) {
  Bench bench(GetParam(), quadruped());
  const std::uint64_t fresh = bench.engine->state_hash(0);
  bench.engine->place_at(0, some_pose(bench.robot, 2));
  EXPECT_NE(bench.engine->state_hash(0), fresh);
  bench.steps(5);
  bench.engine->place(0);
  EXPECT_EQ(bench.engine->state_hash(0), fresh);
}

}  // namespace
}  // namespace amble::physics
