#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "amble/core/random.hpp"
#include "amble/ground/ground.hpp"
#include "tests/physics/scene.hpp"

namespace amble::physics {
namespace {

using ground::Ground;
using ground::HeightField;

class UnevenGround : public OnEachEngine {};
ON_EACH_ENGINE(UnevenGround);
class Slope : public OnEachEngine {};
ON_EACH_ENGINE(Slope);

std::shared_ptr<const Ground> on(const HeightField& field, const robot::RobotSpec& robot) {
  return std::make_shared<const Ground>(field, robot);
}

/// Heights of a function of x, for |x| and |y| below half a period.
HeightField profile(double (*height_m)(double x_m)) {
  HeightField field(0.04);
  for (int j = 0; j < HeightField::cells; ++j)
    for (int i = -HeightField::cells / 2; i < HeightField::cells / 2; ++i)
      field.node(i, j) = static_cast<float>(height_m(0.04 * i));
  return field;
}

HeightField hills(double height_m = 0.15) {
  ground::Settings settings;
  settings.kind = "hills";
  settings.height_m = height_m;
  return make_field(settings, {});
}

/// A ball of 2 kg and 0.1 m with the moment of inertia of a solid one.
robot::RobotSpec ball(double friction) {
  robot::RobotSpec robot = scene("box");
  robot.geoms[0].shape = robot::Shape::sphere;
  robot.geoms[0].size_m = {0.1, 0.0, 0.0};
  robot.bodies[0].inertia_kg_m2 = 0.4 * 2.0 * 0.01 * Vec3{1.0, 1.0, 1.0};
  robot.contact.friction = friction;
  return robot;
}

StartPose upright_at(const robot::RobotSpec& robot, Vec3 place_m) {
  return {.root = {place_m, robot.bodies[0].rotation},
          .joint_angle_rad = std::vector<double>(robot.joints.size(), 0.0)};
}

/// The same, as high over the ground as the robot's own start pose is over the plane.
StartPose on_ground(const robot::RobotSpec& robot, const Ground& ground, double x_m, double y_m) {
  StartPose pose = upright_at(robot, robot.bodies[0].position_m + Vec3{x_m, y_m, 0.0});
  const auto bodies =
      robot::poses_at(robot, {pose.root.position_m, pose.root.rotation}, pose.joint_angle_rad);
  pose.root.position_m.z +=
      robot::clearance_m(robot, robot::start_poses(robot)) - ground.clearance_m(robot, bodies);
  return pose;
}

TEST_P(UnevenGround, ABallRollsDownARampWithFiveSeventhsOfTheSlopesGravity) {
  // a = g sin α / (1 + I / (m r²)) with I = 2/5 m r² (rolling without slipping); h = −x / 4.
  const double slope = 0.25, angle = std::atan(slope), h = 0.001;
  Bench bench(GetParam(), ball(std::numeric_limits<double>::infinity()), h);
  bench.engine->set_ground(on(profile([](double x) { return -0.25 * x; }), bench.robot));
  const double away_m = 0.1 * std::sqrt(1.0 + slope * slope);
  bench.engine->place_at(0, upright_at(bench.robot, {0.0, 0.5, away_m}));
  bench.steps(200);  // the contact's spring settles
  const Vec3 before = bench.engine->momentum_kg_m_s(0);
  bench.steps(600);
  const Vec3 change = bench.engine->momentum_kg_m_s(0) - before;
  const double acceleration = std::hypot(change.x, change.z) / (2.0 * 0.6);
  EXPECT_NEAR(acceleration, 5.0 / 7.0 * 9.8 * std::sin(angle), 0.01 * 9.8);
  EXPECT_NEAR(std::atan2(-change.z, change.x), angle, 0.01);
  EXPECT_NEAR(bench.engine->momentum_kg_m_s(0).y, 0.0, 1e-3);
}

TEST_P(UnevenGround, ABallRollsStraightDownWhicheverWayTheGroundFalls) {
  const double slope = 0.25, angle = std::atan(slope), h = 0.002;
  Bench bench(GetParam(), ball(std::numeric_limits<double>::infinity()), h);
  for (int degrees = 0; degrees < 360; degrees += 45) {
    const double direction_rad = degrees * std::numbers::pi / 180.0;
    const Vec3 down{std::cos(direction_rad), std::sin(direction_rad), 0.0};
    HeightField plane(0.04);
    for (int j = -HeightField::cells / 2; j < HeightField::cells / 2; ++j)
      for (int i = -HeightField::cells / 2; i < HeightField::cells / 2; ++i)
        plane.node(i, j) = static_cast<float>(-slope * 0.04 * (down.x * i + down.y * j));
    bench.engine->set_ground(on(plane, bench.robot));
    bench.engine->place_at(0, upright_at(bench.robot, {0.0, 0.0, 0.1 * std::sqrt(1.0 + slope * slope)}));
    bench.steps(300);
    const Vec3 momentum = bench.engine->momentum_kg_m_s(0);
    const double expected = 5.0 / 7.0 * 9.8 * std::sin(angle) * std::cos(angle) * 2.0 * 300 * h;
    EXPECT_NEAR(dot(momentum, down), expected, 0.03 * expected) << degrees;
    EXPECT_NEAR(norm(cross(down, {momentum.x, momentum.y, 0.0})), 0.0, 0.01 * expected) << degrees;
  }
}

TEST_P(UnevenGround, ABallComesToRestInTheBottomOfAValley) {
  Bench bench(GetParam(), ball(0.8));
  const auto valley = on(profile([](double x) { return 0.5 * x * x; }), bench.robot);
  bench.engine->set_ground(valley);
  bench.engine->place_at(0, upright_at(bench.robot, {0.6, 0.0, 0.4}));
  double lowest_x = 1.0;
  for (int n = 0; n < 600; ++n) {
    bench.steps(1);
    const Vec3 com = bench.engine->com_m(0);
    lowest_x = std::min(lowest_x, com.x);
    // Never through the ground, and never up again as high as it began.
    ASSERT_GT(valley->touch(com, 0.1).gap_m, -0.02) << n;
    ASSERT_LT(com.z, 0.41) << n;
  }
  EXPECT_LT(lowest_x, -0.1) << "it rolls to the other side";
}

TEST_P(UnevenGround, AQuadrupedStandsOnAStepAsGeometrySays) {
  // All feet of one side on a plateau of 0.1 m: the torso leans by the height over the distance of the feet.
  robot::RobotSpec robot = quadruped();
  robot.contact.friction = 1.0;
  Bench bench(GetParam(), robot, 0.005);
  const auto poses = robot::start_poses(robot);
  double front_m = -10.0, hind_m = 10.0;
  for (const auto& leg : robot.legs) {
    const double x = robot::centre_m(robot.geoms[static_cast<std::size_t>(leg.foot_geoms[0])], poses).x;
    front_m = std::max(front_m, x);
    hind_m = std::min(hind_m, x);
  }
  const auto step = on(profile([](double x) { return x > 0.0 ? 0.1 : 0.0; }), robot);
  bench.engine->set_ground(step);
  bench.engine->place_at(0, on_ground(robot, *step, 0.0, 0.0));
  bench.steps(800);
  for (int leg = 0; leg < 4; ++leg) EXPECT_TRUE(bench.touches(leg)) << leg;
  const Vec3 before = bench.engine->com_m(0);
  bench.steps(200);
  EXPECT_LT(norm(bench.engine->com_m(0) - before), 0.01) << "but for its feet's creeping it stands";
  // Up in front is a negative pitch.
  const double lean = std::asin(0.1 / (front_m - hind_m));
  EXPECT_NEAR(static_cast<double>(bench.engine->sensors().attitude_rad.at(1, 0)), -lean, 0.03);
}

TEST_P(UnevenGround, OfHeightZeroIsThePlane) {
  for (const robot::RobotSpec& robot : {quadruped("paper"), lifted(scene("sled"), -1e-4)}) {
    Bench plane(GetParam(), robot), field(GetParam(), robot);
    field.engine->set_ground(on(HeightField(0.04), robot));
    field.engine->place(0);
    for (int n = 0; n < 30; ++n) {
      for (int j = 0; j < plane.targets.rows(); ++j)
        plane.targets.at(j, 0) = field.targets.at(j, 0) = 0.3f * static_cast<float>(std::sin(0.1 * n + j));
      plane.steps(1);
      field.steps(1);
      ASSERT_NEAR(norm(plane.engine->com_m(0) - field.engine->com_m(0)), 0.0,
                  single_precision() ? 2e-5 : 1e-6)
          << n;
      for (std::size_t leg = 0; leg < robot.legs.size(); ++leg)
        ASSERT_EQ(plane.touches(static_cast<int>(leg)), field.touches(static_cast<int>(leg))) << n;
    }
  }
}

TEST_P(UnevenGround, FeetTouchWhereTheGroundSays) {
  const robot::RobotSpec robot = quadruped();
  const auto ground = on(hills(), robot);
  Bench bench(GetParam(), robot);
  bench.engine->set_ground(ground);
  Stream stream(5, Purpose::test);
  int touching = 0, apart = 0;
  for (int n = 0; n < 300; ++n) {
    StartPose pose = on_ground(robot, *ground, stream.uniform(-20.0, 20.0), stream.uniform(-20.0, 20.0));
    pose.root.position_m.z -= stream.uniform(0.0, 0.1);
    bench.engine->place_at(0, pose);
    const auto bodies =
        robot::poses_at(robot, {pose.root.position_m, pose.root.rotation}, pose.joint_angle_rad);
    for (std::size_t leg = 0; leg < robot.legs.size(); ++leg) {
      const robot::Geom& foot = robot.geoms[static_cast<std::size_t>(robot.legs[leg].foot_geoms[0])];
      const double gap_m = ground->touch(robot::centre_m(foot, bodies), foot.size_m.x).gap_m;
      if (std::abs(gap_m) < 1e-5) continue;  // rounding may decide
      EXPECT_EQ(bench.touches(static_cast<int>(leg)), gap_m <= 0.0) << n << ' ' << leg;
      ++(gap_m <= 0.0 ? touching : apart);
    }
  }
  EXPECT_GT(touching, 100);
  EXPECT_GT(apart, 100);
}

TEST_P(UnevenGround, EveryShapeRestsOnItsPoints) {
  // On level ground that is given as a field, high above the plane.
  for (const robot::Shape shape : {robot::Shape::box, robot::Shape::cylinder, robot::Shape::sphere,
                                   robot::Shape::capsule, robot::Shape::mesh}) {
    robot::RobotSpec robot = scene("box");
    robot.geoms[0].shape = shape;
    if (shape == robot::Shape::mesh) become_pyramid(robot.geoms[0]);
    if (shape == robot::Shape::capsule)
      robot.geoms[0].rotation = axis_angle({0.0, 1.0, 0.0}, std::numbers::pi / 2);
    const auto ground = on(profile([](double) { return 0.75; }), robot);
    Bench bench(GetParam(), robot);
    bench.engine->set_ground(ground);
    StartPose pose = on_ground(robot, *ground, 0.3, 0.2);
    pose.root.position_m.z -= robot::clearance_m(robot, robot::start_poses(robot));
    bench.engine->place_at(0, pose);
    const double before_m = bench.engine->com_m(0).z;
    bench.steps(200);
    EXPECT_NEAR(bench.engine->com_m(0).z, before_m, 2e-3) << static_cast<int>(shape);
    EXPECT_NEAR(norm(bench.engine->momentum_kg_m_s(0)), 0.0, 2e-3) << static_cast<int>(shape);
  }
}

TEST_P(UnevenGround, IsLeftAgainForThePlane) {
  Bench bench(GetParam(), quadruped());
  const auto trial = [&] {
    bench.engine->place(0);
    bench.steps(50);
    return bench.engine->state_hash(0);
  };
  const auto plane = trial();
  bench.engine->set_ground(on(profile([](double) { return -0.2; }), bench.robot));
  const auto lower = trial();
  EXPECT_NE(lower, plane);
  bench.engine->set_ground(nullptr);
  EXPECT_EQ(trial(), plane);
  bench.engine->set_ground(on(profile([](double) { return -0.2; }), bench.robot));
  EXPECT_EQ(trial(), lower);
}

TEST_P(Slope, AttitudeIsMeasuredAgainstGravity) {
  robot::RobotSpec robot = quadruped();
  ground::Settings settings;
  settings.slope_x = 0.2;
  robot.gravity_m_s2 = settings.tilted(robot.gravity_m_s2);
  const Bench bench(GetParam(), robot);
  // Uphill is ahead: the nose is up, which is a negative pitch.
  EXPECT_NEAR(static_cast<double>(bench.engine->sensors().attitude_rad.at(0, 0)), 0.0, 1e-6);
  EXPECT_NEAR(static_cast<double>(bench.engine->sensors().attitude_rad.at(1, 0)), -std::atan(0.2), 1e-6);
  EXPECT_NEAR(static_cast<double>(bench.engine->sensors().attitude_rad.at(2, 0)), 0.0, 1e-6);
}

TEST_P(Slope, IsTheSameAsAFieldThatRises) {
  // A sled that is held: on the tilted plane, and on a ramp under straight gravity, turned with it.
  const double rise = 0.3;
  robot::RobotSpec tilted = ball(std::numeric_limits<double>::infinity()), straight = tilted;
  ground::Settings settings;
  settings.slope_x = -rise;
  tilted.gravity_m_s2 = settings.tilted(tilted.gravity_m_s2);
  Bench slope(GetParam(), tilted), ramp(GetParam(), straight);
  ramp.engine->set_ground(on(profile([](double x) { return -0.3 * x; }), straight));
  const double away_m = 0.1 * std::sqrt(1.0 + rise * rise);
  ramp.engine->place_at(0, upright_at(straight, {0.0, 0.0, away_m}));
  slope.steps(100);
  ramp.steps(100);
  const Vec3 moved = ramp.engine->com_m(0) - Vec3{0.0, 0.0, away_m};
  EXPECT_NEAR(std::hypot(moved.x, moved.z), slope.engine->com_m(0).x, 0.01 * slope.engine->com_m(0).x);
}

TEST(UnevenGroundInLanes, EveryInstructionSetAndLaneGivesTheSameBits) {
  const robot::RobotSpec robot = quadruped("paper");
  const auto ground = on(hills(), robot);
  const auto walk = [&] {
    const auto engine = make_engine("batch", robot, {});
    engine->set_ground(ground);
    LaneArray targets(12, 16);
    // Lanes 0 and 9 walk alike.
    for (int lane = 0; lane < 16; ++lane)
      engine->place_at(lane, on_ground(robot, *ground, 0.3 * (lane % 9), 0.0));
    for (int n = 0; n < 150; ++n) {
      for (int lane = 0; lane < 16; ++lane)
        for (int j = 0; j < 12; ++j)
          targets.at(j, lane) = 0.5f * static_cast<float>(std::sin(0.06 * n + 1.7 * (lane % 9) * j));
      engine->step(targets);
    }
    std::vector<std::uint64_t> hashes;
    hashes.reserve(16);
    for (int lane = 0; lane < 16; ++lane) hashes.push_back(engine->state_hash(lane));
    return hashes;
  };
  const auto best = walk();
  for (std::size_t lane = 9; lane < 16; ++lane) EXPECT_EQ(best[lane], best[lane - 9]);
  EXPECT_NE(best[0], best[1]);
  const std::int64_t all = hwy::SupportedTargets();
  for (const std::int64_t set : {std::int64_t{HWY_AVX3}, std::int64_t{HWY_AVX2}, std::int64_t{HWY_SCALAR}}) {
    if ((all & set) == 0 && set != HWY_SCALAR) continue;
    hwy::SetSupportedTargetsForTest(set);
    EXPECT_EQ(walk(), best) << hwy::TargetName(set);
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST(UnevenGroundInLanes, EnginesAgreeOverTheFirstSteps) {
  const robot::RobotSpec robot = quadruped();
  const auto ground = on(hills(0.1), robot);
  std::vector<Vec3> after;
  for (const char* engine : {"ode", "batch", "mujoco"}) {
    Bench bench(engine, robot);
    bench.engine->set_ground(ground);
    bench.engine->place_at(0, on_ground(robot, *ground, 2.0, 1.0));
    bench.steps(25);
    after.push_back(bench.engine->com_m(0));
  }
  EXPECT_NEAR(norm(after[0] - after[1]), 0.0, 5e-3);
  EXPECT_NEAR(norm(after[0] - after[2]), 0.0, 5e-3);
}

}  // namespace
}  // namespace amble::physics
