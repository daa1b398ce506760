#include "amble/robot/check.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "amble/core/index.hpp"
#include "tests/morphology/files.hpp"

namespace amble::robot {
namespace {

using morphology::Files;
using morphology::load_one_leg;
using morphology::with;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string problem_after(const std::function<void(RobotSpec&)>& change) {
  const Files files;
  RobotSpec robot = load_one_leg(files);
  change(robot);
  try {
    check_robot(robot, [](const std::string& problem) { throw std::runtime_error(problem); });
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(CheckRobot, AcceptsAGoodOne) {
  EXPECT_EQ(problem_after([](RobotSpec&) {}), "");
}

TEST(CheckRobot, FindsBodiesThatCannotBe) {
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.bodies.clear(); }), "the robot has no body");
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.bodies[1].mass_kg = 0.0; }),
            "body 'thigh' must have a positive mass");
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.bodies[1].mass_kg = nan; }),
            "body 'thigh' must have a positive mass");
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.bodies[2].inertia_kg_m2.y = -1.0; }),
            "body 'shin' must have positive moments of inertia");
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.bodies[1].parent = 2; }),
            "body 'thigh' must come after its parent");
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.bodies[2].rotation.w = 2.0; }),
            "body 'shin' must have a finite position and a unit rotation");
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.bodies[2].com_m.z = nan; }),
            "body 'shin' must have a finite centre of mass and unit principal axes");
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.joints[1].body = 1; }),
            "body 'shin' is not moved by any joint");
}

TEST(CheckRobot, FindsGeomsAndJointsThatCannotBe) {
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.geoms[0].body = 7; }),
            "geom 'torso' names a body that is not there");
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.geoms[0].size_m.z = 0.0; }),
            "geom 'torso' must have a positive height");
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.geoms[1].size_m.y = -1.0; }),
            "geom 'thigh' must have a positive length");
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.geoms[3].size_m.x = nan; }),
            "geom 'A_foot' must have a positive size");
  EXPECT_EQ(problem_after([](RobotSpec& r) {
              r.joints[0].axis = {0.0, 2.0, 0.0};
            }),
            "joint 'A_hip' must have an axis of length 1");
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.joints[0].lower_rad = 0.5; }),
            "joint 'A_hip' must have a lower stop below its upper stop");
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.joints[0].servo.max_torque_nm = nan; }),
            "joint 'A_hip' must have servo numbers that are finite and not negative");
}

TEST(CheckRobot, FindsLegsThatDoNotFit) {
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.joint_types.pop_back(); }),
            "leg 'A' must have a joint, or none, for each joint type");
  EXPECT_EQ(problem_after([](RobotSpec& r) { std::swap(r.legs[0].joints[0], r.legs[0].joints[1]); }),
            "leg 'A' has joints out of control order");
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.legs[0].foot_geom = -1; }),
            "leg 'A' names a foot that is not there");
  EXPECT_EQ(problem_after([](RobotSpec& r) {
              r.geoms[to_index(r.legs[0].foot_geom)].body = 1;
              r.legs[0].joints[1] = -1;
            }),
            "joint 'A_knee' belongs to no leg, so it cannot be driven");
}

TEST(CheckRobot, TakesLegsThatLackAJointAndJointsThatAreHeld) {
  EXPECT_EQ(problem_after([](RobotSpec& r) {
              r.geoms[to_index(r.legs[0].foot_geom)].body = 1;
              r.legs[0].joints[1] = -1;
              r.joints[1].command = AngleRange{};
            }),
            "");
}

TEST(CheckRobot, FindsRangesOfCommandThatDoNotFit) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::string outside = "joint 'A_hip' must have a range of command within its stops";
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.joints[0].command = AngleRange{-0.6, 0.2}; }), outside);
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.joints[0].command = AngleRange{0.2, 0.1}; }), outside);
  EXPECT_EQ(problem_after([&](RobotSpec& r) { r.joints[0].upper_rad = infinity; }),
            "joint 'A_hip' has no stops, so it needs a range of command");
  EXPECT_EQ(problem_after([&](RobotSpec& r) {
              r.joints[0].upper_rad = infinity;
              r.joints[0].command = AngleRange{-0.5, 2.0};
            }),
            "");
}

TEST(CheckRobot, FindsNumbersThatCannotBe) {
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.contact.friction = nan; }),
            "contact.friction must not be negative");
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.contact.erp = 0.0; }), "contact.erp must be in (0, 1], not 0");
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.contact.cfm_s_per_kg = -1.0; }),
            "contact.cfm_s_per_kg must be finite and not negative");
  for (const int sweeps : {-1, 1001})
    EXPECT_EQ(problem_after([&](RobotSpec& r) { r.contact.sweeps = sweeps; }),
              "contact.sweeps must be in [0, 1000], not " + std::to_string(sweeps));
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.contact.sweeps = 1000; }), "");
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.gravity_m_s2.x = nan; }), "gravity must be finite");
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.fall_height_m = nan; }), "fall_height_m must be finite");
}

TEST(CheckRobot, DrawsItsLimitsWhereTheMessagesSay) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto accepted = [](const std::function<void(RobotSpec&)>& change) {
    return problem_after(change).empty();
  };
  for (const double erp : {1e-9, 0.5, 1.0})
    EXPECT_TRUE(accepted([&](RobotSpec& r) { r.contact.erp = erp; })) << erp;
  for (const double erp : {-0.1, 0.0, 1.0001, infinity, nan})
    EXPECT_FALSE(accepted([&](RobotSpec& r) { r.contact.erp = erp; })) << erp;
  for (const double friction : {0.0, 1.0, infinity})
    EXPECT_TRUE(accepted([&](RobotSpec& r) { r.contact.friction = friction; })) << friction;
  EXPECT_FALSE(accepted([](RobotSpec& r) { r.contact.friction = -1e-9; }));
  EXPECT_TRUE(accepted([](RobotSpec& r) { r.contact.cfm_s_per_kg = 0.0; }));
  EXPECT_FALSE(accepted([](RobotSpec& r) { r.contact.cfm_s_per_kg = infinity; }));
  EXPECT_TRUE(accepted([](RobotSpec& r) { r.contact.sweeps = 0; }));

  for (const int parent : {-2, -1, 1, 2, 3})
    EXPECT_EQ(problem_after([&](RobotSpec& r) { r.bodies[1].parent = parent; }),
              "body 'thigh' must come after its parent")
        << parent;
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.bodies[0].parent = 0; }),
            "body 'torso' must come after its parent");

  // The hip's stops are ± 0.5 rad.
  for (const AngleRange& range : {AngleRange{-0.5, 0.5}, {-0.5, -0.4}, {0.0, 0.1}})
    EXPECT_TRUE(accepted([&](RobotSpec& r) { r.joints[0].command = range; }))
        << range.lower_rad << " to " << range.upper_rad;
  for (const AngleRange& range : {AngleRange{-0.5, 0.51}, {-0.51, 0.5}, {0.6, 0.7}, {0.2, 0.1}})
    EXPECT_EQ(problem_after([&](RobotSpec& r) { r.joints[0].command = range; }),
              "joint 'A_hip' must have a range of command within its stops")
        << range.lower_rad << " to " << range.upper_rad;
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.geoms[to_index(r.legs[0].foot_geom)].collides = false; }),
            "leg 'A' has a foot that cannot collide");
}

TEST(CheckRobot, TakesHullsOfFourCornersAndFourTriangles) {
  const std::vector<Vec3> corners{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
  const std::vector<std::array<int, 3>> triangles{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  const auto problem = [&](std::size_t lost_corners, std::size_t lost_triangles) {
    return problem_after([&](RobotSpec& r) {
      Geom& geom = r.geoms[0];
      geom.shape = Shape::mesh;
      geom.size_m = {0.1, 0, 0};
      geom.vertices_m = {corners.begin(), corners.end() - static_cast<std::ptrdiff_t>(lost_corners)};
      geom.triangles = {triangles.begin(), triangles.end() - static_cast<std::ptrdiff_t>(lost_triangles)};
    });
  };
  EXPECT_EQ(problem(0, 0), "");
  EXPECT_NE(problem(0, 1).find("must have at least four corners"), std::string::npos);
  EXPECT_NE(problem(1, 0).find("must have at least four corners"), std::string::npos);
}

}  // namespace
}  // namespace amble::robot
