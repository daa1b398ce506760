#include "amble/motion/motion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/motion/fixture.hpp"

namespace amble::motion {
namespace {

using testing::ElementsAre;

constexpr double quarter = std::numbers::pi / 2;

void expect_near(Vec3 actual, Vec3 expected) {
  EXPECT_NEAR(actual.x, expected.x, 1e-12);
  EXPECT_NEAR(actual.y, expected.y, 1e-12);
  EXPECT_NEAR(actual.z, expected.z, 1e-12);
}

/// Where the front left foot is, with its knee, hip_fb and hip_io at these angles.
Vec3 foot(double knee_rad, double fb_rad, double io_rad, const robot::Pose& root = {{0, 0, 1}, {}}) {
  const robot::RobotSpec robot = tests::robot();
  std::vector<double> angles(12, 0.0);
  angles[0] = knee_rad;
  angles[1] = fb_rad;
  angles[2] = io_rad;
  return robot::centre_m(robot.geoms[3], robot::poses_at(robot, root, angles));
}

// The hip is at (0.5, 0.2, 1), the upper leg 0.5 m and the lower leg with the foot's centre 0.4 m long.
TEST(Motion, LegsHangStraightAtZero) {
  expect_near(foot(0, 0, 0), {0.5, 0.2, 0.1});
}

TEST(Motion, HipSwingsTheLegBackward) {
  expect_near(foot(0, quarter, 0), {0.5 - 0.9, 0.2, 1});
}

TEST(Motion, HipSwingsTheLegOutward) {
  expect_near(foot(0, 0, quarter), {0.5, 0.2 + 0.9, 1});
}

TEST(Motion, KneeBringsTheFootForward) {
  expect_near(foot(-quarter, 0, 0), {0.5 + 0.4, 0.2, 0.5});
}

TEST(Motion, SecondHingeOfABodyIsCarriedByTheFirst) {
  // Turned outward first, then backward about its own lateral axis; the other order would end at y = 1.1.
  expect_near(foot(0, quarter, quarter), {0.5 - 0.9, 0.2, 1});
}

TEST(Motion, AnglesOfAChainAddUp) {
  expect_near(foot(-quarter, quarter, 0), {0.5 - 0.5, 0.2, 1 - 0.4});
}

TEST(Motion, EverythingMovesWithTheRoot) {
  // Turned to the left, the front left hip is at (−0.2, 0.5) from the root.
  const robot::Pose root{{10, 20, 3}, axis_angle({0, 0, 1}, quarter)};
  expect_near(foot(0, 0, 0, root), {10 - 0.2, 20 + 0.5, 3 - 0.9});
  expect_near(foot(0, quarter, 0, root), {10 - 0.2, 20 + 0.5 - 0.9, 3});
}

TEST(Motion, AnAnchorStaysWhereItIs) {
  robot::RobotSpec robot = tests::robot();
  robot.joints[0].anchor_m = {0, 0, 0.1};
  std::vector<double> angles(12, 0.0);
  angles[0] = 2 * quarter;
  // The lower leg turns upside down about a point 0.1 m above its frame, which was at z = 0.5.
  const auto poses = robot::poses_at(robot, {{0, 0, 1}, {}}, angles);
  expect_near(poses[2].position_m, {0.5, 0.2, 0.7});
}

TEST(Motion, ReadsAFrameOfAMotion) {
  auto recorded = tests::walk(3);
  recorded.motion.angle_rad[1][2] = static_cast<float>(quarter);
  const auto poses = body_poses(recorded.robot, recorded.motion, 2);
  const Vec3 at = robot::centre_m(recorded.robot.geoms[3], poses);
  EXPECT_NEAR(at.x, 0.15 + 0.5 - 0.9, 1e-6);
  EXPECT_NEAR(at.z, 1.0, 1e-6);
}

TEST(CommandedPath, TurnsToTheLeftFromTheAxisOfTheFirstFrame) {
  auto recorded = tests::walk(3);
  Motion& motion = recorded.motion;
  EXPECT_TRUE(commanded_path_m(recorded.robot, motion).empty()) << "it was told nothing";
  const auto left = static_cast<float>(quarter / motion.frame_s),
             metre = static_cast<float>(1.0 / motion.frame_s);
  motion.root_rotation.assign(
      3, Quat{std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)} * recorded.robot.bodies[0].rotation);
  motion.command = {{metre, left}, {metre, 0.0f}, {metre, -left}};
  const auto path_m = commanded_path_m(recorded.robot, motion);
  ASSERT_EQ(path_m.size(), 4u);
  EXPECT_NEAR(norm(path_m[0] - motion.com_start_m), 0.0, 1e-12);
  EXPECT_NEAR(norm(path_m[1] - path_m[0] - Vec3{0, 1, 0}), 0.0, 1e-6);
  EXPECT_NEAR(norm(path_m[2] - path_m[1] - Vec3{-1, 0, 0}), 0.0, 1e-6);
  EXPECT_NEAR(norm(path_m[3] - path_m[2] - Vec3{-1, 0, 0}), 0.0, 1e-6);
}

TEST(Summary, HasTheOutcome) {
  Motion motion = tests::walk(2).motion;
  for (const auto outcome : {record::Outcome::completed, record::Outcome::fell}) {
    motion.outcome = outcome;
    EXPECT_EQ(summarise(motion).outcome, outcome);
  }
}

TEST(Summary, CountsFromBeforeTheFirstStep) {
  const Summary summary = summarise(tests::walk(20).motion);
  EXPECT_NEAR(summary.distance_m, 1.0, 1e-12);
  EXPECT_NEAR(summary.seconds, 2.0, 1e-12);
  EXPECT_NEAR(summary.mean_speed_m_s, 0.5, 1e-12);
}

TEST(Summary, MeasuresDistanceOverTheGround) {
  Motion motion = tests::walk(1).motion;
  motion.com_m.back() = motion.com_start_m + Vec3{3, -4, 12};
  EXPECT_NEAR(summarise(motion).distance_m, 5.0, 1e-12);
}

TEST(Summary, CountsTriggersLegByLeg) {
  // Leg 0 comes down in frames 4 and 8, which gives triggers in 5 and 9; leg 3 in 1, 5 and 9, the last too
  // late.
  const Summary summary = summarise(tests::walk(10).motion);
  EXPECT_THAT(summary.triggers, ElementsAre(2, 2, 2, 2));
}

TEST(Summary, OfNoFramesIsZero) {
  const Summary summary = summarise(tests::walk(0).motion);
  EXPECT_EQ(summary.distance_m, 0.0);
  EXPECT_EQ(summary.mean_speed_m_s, 0.0);
  EXPECT_THAT(summary.triggers, ElementsAre(0, 0, 0, 0));
}

}  // namespace
}  // namespace amble::motion
