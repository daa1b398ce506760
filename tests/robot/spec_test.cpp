#include "amble/robot/spec.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "amble/core/random.hpp"
#include "amble/robot/collision_points.hpp"
#include "amble/robot/sensors.hpp"
#include "tests/morphology/files.hpp"
#include "tests/robot/legged.hpp"

namespace amble::robot {
namespace {

using morphology::Files;
using morphology::load_one_leg;

TEST(RobotSpec, SumsTheMassesOfItsBodies) {
  const Files files;
  EXPECT_DOUBLE_EQ(load_one_leg(files).total_mass_kg(), 4.75);
}

TEST(FallRule, IsMetBelowAboveOrTilted) {
  const FallRule by_height{.below_m = 0.2, .above_m = 1.0};
  EXPECT_TRUE(by_height.met(0.19, 1.0));
  EXPECT_FALSE(by_height.met(0.2, -1.0));
  EXPECT_FALSE(by_height.met(1.0, -1.0));
  EXPECT_TRUE(by_height.met(1.01, 1.0));
  const FallRule by_tilt{.below_m = 0.0, .tilt_rad = 0.5};
  EXPECT_FALSE(by_tilt.met(1e9, std::cos(0.49)));
  EXPECT_TRUE(by_tilt.met(1e9, std::cos(0.51)));
}

TEST(RobotSpec, SeesATiltFromItsOwnStartPose) {
  const Files files;
  RobotSpec robot = load_one_leg(files);
  robot.bodies[0].rotation = axis_angle({0.0, 0.6, 0.8}, 0.7);
  const Quat turned = axis_angle({1.0, 0.0, 0.0}, 0.3) * robot.bodies[0].rotation;
  EXPECT_NEAR(robot.upright(turned), std::cos(0.3), 1e-12);
  EXPECT_NEAR(robot.upright(axis_angle({0.0, 0.0, 1.0}, 2.0) * robot.bodies[0].rotation), 1.0, 1e-12);
}

TEST(RobotSpec, NamesTheJointsOfABodyInTheOrderOfTheChain) {
  RobotSpec robot;
  robot.joints.resize(4);
  for (int j = 0; j < 4; ++j) robot.joints[static_cast<std::size_t>(j)].body = j == 0 ? 1 : 2;
  robot.joints[1].chain_index = 2;
  robot.joints[2].chain_index = 0;
  robot.joints[3].chain_index = 1;
  EXPECT_EQ(robot.joints_of_body(1), std::vector<int>{0});
  EXPECT_EQ(robot.joints_of_body(2), (std::vector<int>{2, 3, 1}));
  EXPECT_TRUE(robot.joints_of_body(0).empty());
}

TEST(RobotSpec, ABodyThatHangsOnALegBelongsToIt) {
  const Files files;
  RobotSpec robot = load_one_leg(files);
  EXPECT_EQ(robot.leg_of_body(0), -1);
  const int shank = robot.joints.back().body;
  EXPECT_EQ(robot.leg_of_body(shank), 0);
  robot.bodies.push_back(robot.bodies.back());
  robot.bodies.back().parent = shank;
  EXPECT_EQ(robot.leg_of_body(static_cast<int>(robot.bodies.size()) - 1), 0);
}

TEST(RobotSpec, ABodyThatCarriesFeetOfSeveralLegsIsOfTheTrunkThoughALegTurnsIt) {
  RobotSpec robot = tests::legged_robot(1);
  // The left leg's last joint is moved to a spine that carries both legs.
  robot.bodies.insert(robot.bodies.begin() + 1, robot.bodies[1]);
  robot.bodies[1].name = "spine";
  for (std::size_t b = 2; b < robot.bodies.size(); ++b) ++robot.bodies[b].parent;
  for (Geom& geom : robot.geoms) geom.body += geom.body > 0;
  for (Joint& joint : robot.joints) ++joint.body;
  robot.joints[2].body = 1;
  EXPECT_EQ(robot.leg_of_body(0), -1);
  EXPECT_EQ(robot.leg_of_body(1), -1);
  EXPECT_EQ(robot.leg_of_body(2), 0);
  EXPECT_EQ(robot.leg_of_body(3), 0);
  EXPECT_EQ(robot.leg_of_body(4), 1);
  EXPECT_EQ(robot.leg_of_body(5), 1);
}

TEST(ContactRadii, AreThoseOfWhatCollidesAndNoughtRising) {
  RobotSpec robot = tests::legged_robot(1);
  EXPECT_EQ(contact_radii_m(robot), (std::vector<double>{0.0, 0.05}));
  robot.geoms.push_back(robot.geoms[1]);
  robot.geoms.back().size_m.x = 0.02;
  EXPECT_EQ(contact_radii_m(robot), (std::vector<double>{0.0, 0.02, 0.05}));
  robot.geoms.back().collides = false;
  EXPECT_EQ(contact_radii_m(robot), (std::vector<double>{0.0, 0.05}));
  for (Geom& geom : robot.geoms) geom.collides = false;
  EXPECT_EQ(contact_radii_m(robot), std::vector<double>{0.0});
}

TEST(LevelFrame, HasItsZAxisAgainstGravityAndIsTurnedAboutALevelAxis) {
  Stream stream(1, Purpose::test);
  for (int round = 0; round < 100; ++round) {
    const Vec3 gravity{stream.uniform(-3.0, 3.0), stream.uniform(-3.0, 3.0), stream.uniform(-9.0, -0.5)};
    const Quat frame = horizontal_frame(gravity);
    EXPECT_NEAR(norm(rotate(frame, {0.0, 0.0, 1.0}) + (1.0 / norm(gravity)) * gravity), 0.0, 1e-12);
    EXPECT_EQ(frame.z, 0.0);
  }
  EXPECT_EQ(horizontal_frame({0.0, 0.0, -9.81}), Quat{});
  EXPECT_EQ(horizontal_frame({}), Quat{});
}

}  // namespace
}  // namespace amble::robot
