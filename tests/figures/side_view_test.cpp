#include "amble/figures/side_view.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "amble/core/random.hpp"
#include "tests/motion/fixture.hpp"

namespace amble::figures {
namespace {

using testing::ElementsAre;

/// A single geom as a robot.
robot::RobotSpec one_geom(robot::Shape shape, Vec3 size_m, Quat rotation = {}) {
  robot::RobotSpec robot;
  robot.bodies.resize(1);
  robot::Geom geom;
  geom.shape = shape;
  geom.size_m = size_m;
  geom.rotation = rotation;
  robot.geoms.push_back(geom);
  return robot;
}

std::pair<Point, Point> bounds(const std::vector<Point>& corners) {
  Point low = corners.at(0), high = low;
  for (const Point corner : corners) {
    low = {std::min(low.x, corner.x), std::min(low.y, corner.y)};
    high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
  }
  return {low, high};
}

Silhouette seen(const robot::RobotSpec& robot, const Camera& camera) {
  return silhouettes(robot, {{{1, 2, 3}, {}}}, camera).at(0);
}

TEST(ConvexHull, IsCounterClockwiseWithoutInnerAndCollinearPoints) {
  EXPECT_THAT(convex_hull({{0, 0}, {2, 2}, {1, 0}, {2, 0}, {1, 1}, {0, 2}, {0, 0}}),
              ElementsAre(Point{0, 0}, Point{2, 0}, Point{2, 2}, Point{0, 2}));
}

TEST(ConvexHull, HoldsAllPointsOnItsLeft) {
  Stream stream(2, Purpose::test);
  for (int round = 0; round < 300; ++round) {
    std::vector<Point> points;
    for (int i = 0; i < 20; ++i) points.push_back({stream.uniform(-1, 1), stream.uniform(-1, 1)});
    const auto hull = convex_hull(points);
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Point a = hull[i], b = hull[(i + 1) % hull.size()];
      for (const Point p : points) ASSERT_GE((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x), -1e-12);
    }
  }
}

TEST(Camera, FromTheSideSeesTheWalkerGoRight) {
  // Who walks along +y has their right-hand side at +x, so the camera looks along −x.
  const Camera camera = side_camera({0, 1, 0});
  EXPECT_EQ(camera.right, (Vec3{0, 1, 0}));
  EXPECT_EQ(camera.up, (Vec3{0, 0, 1}));
  EXPECT_EQ(camera.away, (Vec3{-1, 0, 0}));
}

TEST(Camera, FromAboveIsNotMirrored) {
  for (const bool x_up : {false, true}) {
    const Camera camera = top_camera(x_up);
    EXPECT_EQ(cross(camera.right, camera.up), (Vec3{0, 0, 1}));
    EXPECT_EQ(x_up ? camera.up : camera.right, (Vec3{1, 0, 0}));
  }
}

TEST(Silhouette, OfABoxIsItsFace) {
  const auto [low, high] =
      bounds(seen(one_geom(robot::Shape::box, {0.1, 0.2, 0.3}), side_camera({1, 0, 0})).corners_m);
  EXPECT_NEAR(low.x, 0.9, 1e-12);
  EXPECT_NEAR(high.x, 1.1, 1e-12);
  EXPECT_NEAR(low.y, 2.7, 1e-12);
  EXPECT_NEAR(high.y, 3.3, 1e-12);
}

TEST(Silhouette, OfATurnedBoxHasSixCorners) {
  const Quat turn = axis_angle({0, 0, 1}, 0.5) * axis_angle({1, 0, 0}, 0.7);
  EXPECT_EQ(seen(one_geom(robot::Shape::box, {0.1, 0.2, 0.3}, turn), side_camera({1, 0, 0})).corners_m.size(),
            6u);
}

TEST(Silhouette, OfASphereIsACircle) {
  const Silhouette sphere = seen(one_geom(robot::Shape::sphere, {0.25, 0, 0}), side_camera({1, 0, 0}));
  EXPECT_TRUE(sphere.corners_m.empty());
  EXPECT_EQ(sphere.radius_m, 0.25);
  EXPECT_EQ(sphere.centre_m, (Point{1, 3}));
  EXPECT_EQ(sphere.depth_m, 2.0);
}

TEST(Silhouette, OfACapsuleIsLongerThanOfACylinderByItsRadii) {
  for (const robot::Shape shape : {robot::Shape::capsule, robot::Shape::cylinder}) {
    const auto [low, high] = bounds(seen(one_geom(shape, {0.1, 0.4, 0}), side_camera({1, 0, 0})).corners_m);
    EXPECT_NEAR(high.y - low.y, shape == robot::Shape::capsule ? 1.0 : 0.8, 1e-12);
    EXPECT_NEAR(high.x - low.x, 0.2, 1e-12);
  }
}

TEST(Silhouette, OfAnUprightCylinderFromAboveIsRound) {
  const auto outline = seen(one_geom(robot::Shape::cylinder, {0.1, 0.4, 0}), top_camera(false)).corners_m;
  for (const Point corner : outline) EXPECT_NEAR(std::hypot(corner.x - 1, corner.y - 2), 0.1, 1e-12);
  EXPECT_GE(outline.size(), 16u);
}

TEST(Silhouettes, ComeFromFarToNear) {
  const auto recorded = tests::walk(1);
  const auto outlines = silhouettes(recorded.robot, motion::body_poses(recorded.robot, recorded.motion, 0),
                                    side_camera({1, 0, 0}));
  ASSERT_EQ(outlines.size(), 13u);
  for (std::size_t i = 1; i < outlines.size(); ++i) EXPECT_GE(outlines[i - 1].depth_m, outlines[i].depth_m);
  EXPECT_EQ(recorded.robot.leg_of_body(recorded.robot.geoms[static_cast<std::size_t>(outlines[0].geom)].body),
            0);
}

TEST(SideView, HasNoLegThatADamageTookAway) {
  auto recorded = tests::walk(1);
  const int frame = 0;
  const auto limbs = [&] {
    Svg svg(100, 100, "");
    const auto views = side_views(recorded.robot, recorded.motion, {&frame, 1});
    draw_robot(svg, recorded.robot, recorded.motion, views[0],
               {.box = {0, 0, 100, 100}, .ground_px = 90, .px_per_m = 20});
    const std::string text = svg.finish();
    std::size_t count = 0;
    for (std::size_t at = text.find("class=\"limb\""); at != std::string::npos;
         at = text.find("class=\"limb\"", at + 1))
      ++count;
    return count;
  };
  const std::size_t before = limbs();
  std::size_t gone = 0;
  for (robot::Geom& geom : recorded.robot.geoms)
    if (recorded.robot.leg_of_body(geom.body) == 1) {
      geom.rgba = robot::gone_rgba;
      ++gone;
    }
  EXPECT_GT(gone, 1u);
  EXPECT_LT(limbs(), before);
}

TEST(MeanHeading, IsTheWayItWent) {
  motion::Motion motion = tests::walk(10).motion;
  motion.com_m.back() = motion.com_m.front() + Vec3{0, -2, 5};
  const Vec3 heading = mean_heading(motion, 0, 9);
  EXPECT_NEAR(heading.x, 0, 1e-12);
  EXPECT_NEAR(heading.y, -1, 1e-12);
  EXPECT_NEAR(heading.z, 0, 1e-12);
}

TEST(MeanHeading, IsTheWayItFacedIfItStayed) {
  motion::Motion motion = tests::walk(10).motion;
  for (auto& com_m : motion.com_m) com_m = {};
  for (auto& rotation : motion.root_rotation) rotation = axis_angle({0, 0, 1}, std::numbers::pi / 2);
  const Vec3 heading = mean_heading(motion, 0, 9);
  EXPECT_NEAR(heading.x, 0, 1e-12);
  EXPECT_NEAR(heading.y, 1, 1e-12);
}

}  // namespace
}  // namespace amble::figures
