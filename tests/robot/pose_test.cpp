#include "amble/robot/pose.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "amble/core/random.hpp"
#include "tests/morphology/files.hpp"

namespace amble::robot {
namespace {

using morphology::Files;
using morphology::load_one_leg;

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
  robot.joints[0].anchor_m = {0.0, 0.0, 1.0};  // the origin of the root's frame
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

TEST(Bottom, TheLowestPointOfAGeomIsThatOfItsCorners) {
  const std::vector<Pose> poses{{{0.0, 0.0, 2.0}, axis_angle({1.0, 0.0, 0.0}, 0.5 * quarter)}};
  const double diagonal = std::sqrt(0.5);
  const auto bottom_m = [&](Shape shape, Vec3 size_m) {
    Geom geom;
    geom.shape = shape;
    geom.size_m = size_m;
    return amble::robot::bottom_m(geom, poses);
  };
  EXPECT_NEAR(bottom_m(Shape::sphere, {0.3, 0.0, 0.0}), 2.0 - 0.3, 1e-12);
  EXPECT_NEAR(bottom_m(Shape::capsule, {0.1, 0.4, 0.0}), 2.0 - 0.1 - 0.4 * diagonal, 1e-12);
  EXPECT_NEAR(bottom_m(Shape::cylinder, {0.1, 0.4, 0.0}), 2.0 - (0.1 + 0.4) * diagonal, 1e-12);
  EXPECT_NEAR(bottom_m(Shape::box, {0.7, 0.1, 0.4}), 2.0 - (0.1 + 0.4) * diagonal, 1e-12);
}

TEST(StartCom, IsWhereTheMassesSay) {
  // 1 kg at z = 1 and, turned by a quarter about y, 0.5 kg at 0.2 m in front of (0.5, 0, 1).
  RobotSpec robot;
  robot.bodies.resize(2);
  robot.bodies[0].position_m = {0.0, 0.0, 1.0};
  robot.bodies[0].mass_kg = 1.0;
  robot.bodies[1].parent = 0;
  robot.bodies[1].position_m = {0.5, 0.0, 0.0};
  robot.bodies[1].rotation = axis_angle({0.0, 1.0, 0.0}, quarter);
  robot.bodies[1].mass_kg = 0.5;
  robot.bodies[1].com_m = {0.2, 0.0, 0.0};  // along the world's −z
  EXPECT_NEAR(norm(start_com_m(robot) - Vec3{0.25 / 1.5, 0.0, (1.0 + 0.4) / 1.5}), 0.0, 1e-15);
}

TEST(PoseAlong, LeavesTheHingesFurtherOutAtZero) {
  RobotSpec robot;
  robot.bodies.resize(2);
  robot.bodies[1].parent = 0;
  robot.bodies[1].position_m = {0.1, -0.2, -1.0};
  robot.joints.resize(3);
  const Vec3 axes[]{{1.0, 0.0, 0.0}, {0.0, 0.6, 0.8}, {0.0, 1.0, 0.0}};
  const std::vector<double> angles{0.4, -0.9, 1.3};
  for (std::size_t j = 0; j < 3; ++j) {
    robot.joints[j].body = 1;
    robot.joints[j].chain_index = static_cast<int>(j);
    robot.joints[j].axis = axes[j];
    robot.joints[j].anchor_m = {0.1 * static_cast<double>(j), 0.2, 0.3};
  }
  const Pose root{{1.0, 2.0, 3.0}, axis_angle({0.0, 0.0, 1.0}, 0.7)};
  for (std::size_t hinges = 0; hinges <= 4; ++hinges) {
    std::vector<double> cut = angles;
    for (std::size_t j = hinges; j < 3; ++j) cut[j] = 0.0;
    const Pose found = pose_along(robot, 1, root, angles, hinges), expected = poses_at(robot, root, cut)[1];
    for (const Vec3 point : {Vec3{}, Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}})
      EXPECT_NEAR(norm(found * point - expected * point), 0.0, 1e-12) << hinges;
  }
}

TEST(Pose, BottomOfAMeshIsItsLowestVertexWhereverItsOriginIs) {
  Stream stream(1, Purpose::test);
  for (int round = 0; round < 100; ++round) {
    Geom geom;
    geom.shape = Shape::mesh;
    geom.body = 0;
    const double offset_m = stream.uniform(-3.0, 3.0);
    for (int i = 0; i < 6; ++i) {
      geom.vertices_m.push_back(
          {stream.uniform(-0.1, 0.1), stream.uniform(-0.1, 0.1), offset_m + stream.uniform(-0.1, 0.1)});
      geom.size_m.x = std::max(geom.size_m.x, norm(geom.vertices_m.back()));
    }
    const Pose pose{{0.0, 0.0, stream.uniform(-1.0, 1.0)},
                    axis_angle({0.6, 0.8, 0.0}, stream.uniform(-3.0, 3.0))};
    double lowest_m = std::numeric_limits<double>::infinity();
    for (const Vec3 vertex : geom.vertices_m) lowest_m = std::min(lowest_m, (pose * vertex).z);
    EXPECT_NEAR(bottom_m(geom, std::vector<Pose>{pose}), lowest_m, 1e-12);
  }
}

}  // namespace
}  // namespace amble::robot
