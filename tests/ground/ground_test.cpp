#include "amble/ground/ground.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "amble/core/random.hpp"
#include "amble/morphology/robot_file.hpp"
#include "amble/robot/pose.hpp"

namespace amble::ground {
namespace {

robot::RobotSpec quadruped() {
  return morphology::load_robot(AMBLE_SOURCE_DIR "/robots/quadruped/authors.toml");
}

HeightField hills() {
  Settings settings;
  settings.kind = "hills";
  settings.height_m = 0.3;
  return make_field(settings, {});
}

TEST(Ground, TouchesABallAtItsDepthAlongTheNormal) {
  const robot::RobotSpec robot = quadruped();
  const double radius_m = robot.geoms[static_cast<std::size_t>(robot.legs[0].foot_geoms[0])].size_m.x;
  HeightField ramp(0.04);  // h = x / 2
  for (int j = 0; j < 256; ++j)
    for (int i = -128; i < 128; ++i) ramp.node(i, j) = 0.02f * static_cast<float>(i);
  const Ground ground(ramp, robot);
  const Vec3 up{-1.0 / std::sqrt(5.0), 0.0, 2.0 / std::sqrt(5.0)};
  for (const double gap_m : {-0.02, 0.0, 0.1}) {
    const Vec3 centre_m = Vec3{0.7, 0.2, 0.35} + (radius_m + gap_m) * up;
    const Touch touch = ground.touch(centre_m, radius_m);
    EXPECT_NEAR(touch.gap_m, gap_m, 0.01 * radius_m);
    EXPECT_NEAR(norm(touch.normal - up), 0.0, 1e-6);
    EXPECT_NEAR(norm(touch.point_m - (centre_m - radius_m * up)), 0.0, 1e-6);
  }
}

TEST(Ground, OfAPlaneHasItsNormalWhicheverWayItRises) {
  const robot::RobotSpec robot = quadruped();
  for (const auto& [x, y] : {std::pair{0.25, 0.5}, {0.25, -0.5}, {-0.75, 0.5}, {0.0, -1.0}, {-0.5, 0.0}}) {
    HeightField plane(0.04);  // h = x · X + y · Y around the origin
    for (int j = -128; j < 128; ++j)
      for (int i = -128; i < 128; ++i) plane.node(i, j) = static_cast<float>(0.04 * (x * i + y * j));
    const Ground ground(plane, robot);
    const double length = std::sqrt(1.0 + x * x + y * y);
    const Vec3 normal{-x / length, -y / length, 1.0 / length};
    const Vec3 place_m{0.31, -0.17, x * 0.31 - y * 0.17};
    for (const double radius_m : robot::contact_radii_m(robot)) {
      const Touch touch = ground.touch(place_m + radius_m * normal, radius_m);
      EXPECT_NEAR(norm(touch.normal - normal), 0.0, 1e-6) << x << " " << y;
      EXPECT_NEAR(norm(touch.point_m - place_m), 0.0, 1e-6) << x << " " << y;
      EXPECT_NEAR(touch.gap_m, 0.0, 0.01 * radius_m + 1e-6);
    }
  }
}

TEST(Ground, OfALevelFieldIsThePlane) {
  const robot::RobotSpec robot = quadruped();
  const Ground ground(HeightField(0.04), robot);
  const auto poses = robot::start_poses(robot);
  EXPECT_NEAR(ground.clearance_m(robot, poses), robot::clearance_m(robot, poses), 1e-7);
  const Touch touch = ground.touch({3.0, -2.0, 0.5}, 0.0);
  EXPECT_EQ(touch.gap_m, 0.5);
  EXPECT_EQ(touch.normal, (Vec3{0.0, 0.0, 1.0}));
}

TEST(Ground, ARobotLoweredByItsClearanceTouchesWithOnePointAndNoDeeper) {
  const robot::RobotSpec robot = quadruped();
  const Ground ground(hills(), robot);
  Stream stream(3, Purpose::test);
  for (int n = 0; n < 200; ++n) {
    robot::Pose root{{stream.uniform(-8.0, 8.0), stream.uniform(-8.0, 8.0), 2.0},
                     axis_angle({0.6, 0.8, 0.0}, stream.uniform(-1.0, 1.0))};
    const std::vector<double> angles(robot.joints.size(), stream.uniform(-0.3, 0.3));
    root.position_m.z -= ground.clearance_m(robot, robot::poses_at(robot, root, angles));
    const auto poses = robot::poses_at(robot, root, angles);
    EXPECT_NEAR(ground.clearance_m(robot, poses), 0.0, 1e-12);
  }
}

TEST(Ground, IsNotTouchedByWhatDoesNotCollide) {
  robot::RobotSpec robot = quadruped();
  const auto poses = robot::start_poses(robot);
  Stream stream(4, Purpose::test);
  for (int n = 0; n < 10; ++n) {
    for (robot::Geom& geom : robot.geoms) geom.collides = stream.chance(0.5);
    const Ground ground(HeightField(0.04), robot);
    const double expected_m = robot::clearance_m(robot, poses);
    if (std::isfinite(expected_m))
      EXPECT_NEAR(ground.clearance_m(robot, poses), expected_m, 1e-7);
    else
      EXPECT_EQ(ground.clearance_m(robot, poses), expected_m);
  }
}

TEST(Ground, HasAClearanceOfAtLeastTheLeastThatIsKnownBeforeItIsMade) {
  const robot::RobotSpec robot = quadruped();
  const auto poses = robot::start_poses(robot);
  const double plane_m = robot::clearance_m(robot, poses);
  int on_flat = 0, inside = 0;
  for (const char* const kind : {"hills", "stones", "stairs"})
    for (const double cell_m : {0.02, 0.07})
      for (int part = 1; part <= 12; ++part) {
        Settings settings;
        settings.kind = kind;
        settings.height_m = 3.0;
        settings.cell_m = cell_m;
        settings.start_radius_m = 0.1 * part;
        settings.seed = part;
        const HeightField surface = make_field(settings, {});
        const double least_m = least_clearance_m(surface, robot, poses);
        const double clearance_m = Ground(surface, robot).clearance_m(robot, poses);
        EXPECT_LE(least_m, clearance_m + 1e-6) << kind << " " << settings.start_radius_m;
        on_flat += std::abs(least_m - plane_m) < 1e-6 && std::abs(clearance_m - plane_m) < 1e-6;
        inside += clearance_m < -0.5;
      }
  EXPECT_GT(on_flat, 10);
  EXPECT_GT(inside, 10);
}

}  // namespace
}  // namespace amble::ground
