#include "amble/robot/check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

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
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.legs[0].foot_geoms[0] = -1; }),
            "leg 'A' names a foot that is not there");
  EXPECT_EQ(problem_after([](RobotSpec& r) {
              r.geoms[to_index(r.legs[0].foot_geoms[0])].body = 1;
              r.legs[0].joints[1] = -1;
            }),
            "joint 'A_knee' belongs to no leg, so it cannot be driven");
}

TEST(CheckRobot, FindsFeetOfSeveralShapesThatDoNotFit) {
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.legs[0].foot_geoms.clear(); }),
            "leg 'A' has a foot without shapes");
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.legs[0].foot_geoms.push_back(r.legs[0].foot_geoms[0]); }),
            "leg 'A' names a shape of its foot twice");
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.legs[0].foot_geoms.push_back(99); }),
            "leg 'A' names a foot that is not there");
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.legs[0].foot_geoms.push_back(0); }),
            "leg 'A': its foot 'torso' is on body 'torso', which none of its joints moves");
}

TEST(CheckRobot, TakesAFootThatAJointWithoutAMotorMoves) {
  const auto passive_knee = [](RobotSpec& r) {
    r.legs[0].joints[1] = -1;
    r.joints[1].servo = {.mode = ServoMode::none, .gain_per_s = 0.0, .max_torque_nm = 0.0};
    r.joints[1].command = AngleRange{};
    r.joints[1].stiffness_nm_per_rad = 3.0;
  };
  EXPECT_EQ(problem_after(passive_knee), "");
  EXPECT_EQ(problem_after([&](RobotSpec& r) {
              passive_knee(r);
              r.joints[1].servo = {};
            }),
            "joint 'A_knee' has a motor, so it cannot have a spring");
  EXPECT_EQ(
      problem_after([&](RobotSpec& r) {
        passive_knee(r);
        r.joints[1].stiffness_nm_per_rad = -1.0;
      }),
      "joint 'A_knee' must have a spring with a finite stiffness, not negative, and a finite angle at rest");
  EXPECT_EQ(problem_after([&](RobotSpec& r) {
              passive_knee(r);
              r.joints[1].servo.max_torque_nm = 1.0;
            }),
            "joint 'A_knee' has no motor, so the numbers of its servo must be 0");
  EXPECT_EQ(problem_after([&](RobotSpec& r) {
              passive_knee(r);
              r.legs[0].joints[1] = 1;
            }),
            "leg 'A' has a joint without a motor among those it commands");
  EXPECT_EQ(problem_after([&](RobotSpec& r) {
              passive_knee(r);
              r.joints[1].servo = {};
              r.joints[1].stiffness_nm_per_rad = 0.0;
            }),
            "")
      << "held";
}

TEST(CheckRobot, TakesLegsThatLackAJointAndJointsThatAreHeld) {
  EXPECT_EQ(problem_after([](RobotSpec& r) {
              r.geoms[to_index(r.legs[0].foot_geoms[0])].body = 1;
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
  // A servo that holds its torque may press against a stop.
  EXPECT_TRUE(accepted([](RobotSpec& r) {
    r.joints[0].command = AngleRange{-0.8, 0.9};
    r.joints[0].servo.hold_torque = true;
  }));
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.fall_above_m = r.fall_height_m; }),
            "fall_above_m must be above fall_height_m");
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.fall_tilt_rad = 0.0; }), "fall_tilt_rad must be positive");
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.geoms[to_index(r.legs[0].foot_geoms[0])].collides = false; }),
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

using Change = std::function<void(RobotSpec&)>;

void expect_refused(const std::vector<Change>& changes, const std::string& problem) {
  for (std::size_t i = 0; i < changes.size(); ++i) EXPECT_EQ(problem_after(changes[i]), problem) << i;
}

TEST(CheckRobot, FindsEachNumberOfABodyThatCannotBe) {
  expect_refused({[](RobotSpec& r) { r.bodies[2].position_m.x = nan; },
                  [](RobotSpec& r) { r.bodies[2].position_m.y = nan; },
                  [](RobotSpec& r) { r.bodies[2].position_m.z = nan; },
                  [](RobotSpec& r) { r.bodies[2].rotation.z = 0.1; },
                  [](RobotSpec& r) { r.bodies[2].rotation.x = nan; }},
                 "body 'shin' must have a finite position and a unit rotation");
  expect_refused({[](RobotSpec& r) { r.bodies[2].com_m.x = nan; },
                  [](RobotSpec& r) { r.bodies[2].inertia_rotation.y = 0.1; }},
                 "body 'shin' must have a finite centre of mass and unit principal axes");
  expect_refused({[](RobotSpec& r) { r.bodies[2].inertia_kg_m2.x = 0.0; },
                  [](RobotSpec& r) { r.bodies[2].inertia_kg_m2.y = 0.0; },
                  [](RobotSpec& r) { r.bodies[2].inertia_kg_m2.z = 0.0; },
                  [](RobotSpec& r) { r.bodies[2].inertia_kg_m2.y = HUGE_VAL; }},
                 "body 'shin' must have positive moments of inertia");
  expect_refused({[](RobotSpec& r) { r.bodies[2].mass_kg = HUGE_VAL; },
                  [](RobotSpec& r) { r.bodies[2].mass_kg = -1.0; }},
                 "body 'shin' must have a positive mass");
}

TEST(CheckRobot, FindsEachNumberOfAGeomThatCannotBe) {
  expect_refused({[](RobotSpec& r) { r.geoms[1].body = -1; }, [](RobotSpec& r) { r.geoms[1].body = 3; }},
                 "geom 'thigh' names a body that is not there");
  expect_refused({[](RobotSpec& r) { r.geoms[1].position_m.y = nan; },
                  [](RobotSpec& r) { r.geoms[1].rotation.w = 0.9; }},
                 "geom 'thigh' must have a finite position and a unit rotation");
  expect_refused(
      {[](RobotSpec& r) { r.geoms[1].size_m.x = 0.0; }, [](RobotSpec& r) { r.geoms[1].size_m.y = HUGE_VAL; }},
      "geom 'thigh' must have a positive size");
  expect_refused({[](RobotSpec& r) { r.geoms[1].size_m.y = 0.0; }},
                 "geom 'thigh' must have a positive length");
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.geoms[1].size_m.z = 0.0; }), "") << "a capsule has two sizes";
  EXPECT_EQ(problem_after([](RobotSpec& r) { r.geoms[3].size_m.y = r.geoms[3].size_m.z = 0.0; }), "")
      << "a sphere has one";
}

TEST(CheckRobot, FindsEachNumberOfAJointThatCannotBe) {
  expect_refused({[](RobotSpec& r) { r.joints[1].body = -1; }, [](RobotSpec& r) { r.joints[1].body = 0; },
                  [](RobotSpec& r) { r.joints[1].body = 3; }},
                 "joint 'A_knee' names a body that is not there, or the root");
  expect_refused({[](RobotSpec& r) { r.joints[1].anchor_m.z = nan; }},
                 "joint 'A_knee' must have a finite anchor");
  expect_refused({[](RobotSpec& r) { r.joints[1].axis.x = nan; }},
                 "joint 'A_knee' must have an axis of length 1");
  expect_refused({[](RobotSpec& r) { r.joints[1].lower_rad = r.joints[1].upper_rad; }},
                 "joint 'A_knee' must have a lower stop below its upper stop");
  expect_refused({[](RobotSpec& r) { r.joints[1].lower_rad = -HUGE_VAL; },
                  [](RobotSpec& r) { r.joints[1].upper_rad = HUGE_VAL; }},
                 "joint 'A_knee' has no stops, so it needs a range of command");
  const auto shifted = [](double lower_rad, double upper_rad) {
    return problem_after([=](RobotSpec& r) {
      r.joints[1].lower_rad = lower_rad;
      r.joints[1].upper_rad = upper_rad;
    });
  };
  EXPECT_EQ(shifted(0.0, 0.5), "");
  EXPECT_EQ(shifted(-0.5, 0.0), "");
  const std::string outside = "joint 'A_knee': the start pose, angle 0, lies outside its range ";
  EXPECT_EQ(shifted(0.1, 0.5), outside + "0.1 … 0.5 rad");
  EXPECT_EQ(shifted(-0.5, -0.1), outside + "-0.5 … -0.1 rad");
}

TEST(CheckRobot, TakesServosAndPassiveJointsFromNoughtOn) {
  const auto after = [](auto member, double value) {
    return problem_after([=](RobotSpec& r) { member(r.joints[1]) = value; });
  };
  using Member = double& (*)(Joint&);
  const std::vector<Member> servo{[](Joint& j) -> double& { return j.servo.gain_per_s; },
                                  [](Joint& j) -> double& { return j.servo.max_torque_nm; },
                                  [](Joint& j) -> double& { return j.servo.kp_nm_per_rad; },
                                  [](Joint& j) -> double& { return j.servo.kd_nm_s_per_rad; }};
  const std::vector<Member> passive{[](Joint& j) -> double& { return j.armature_kg_m2; },
                                    [](Joint& j) -> double& { return j.damping_nm_s_per_rad; },
                                    [](Joint& j) -> double& { return j.friction_loss_nm; }};
  for (const auto& [members, problem] :
       {std::pair{servo, "servo numbers that are finite and not negative"},
        std::pair{passive, "armature, damping and friction loss that are finite and not negative"}})
    for (std::size_t i = 0; i < members.size(); ++i) {
      EXPECT_EQ(after(members[i], 0.0), "") << i;
      for (const double value : {-1e-9, HUGE_VAL, nan})
        EXPECT_EQ(after(members[i], value), std::string("joint 'A_knee' must have ") + problem) << i;
    }
}

TEST(CheckRobot, TakesRotationsAndAxesThatRoundingMadeAMillionthLongerOrShorter) {
  const auto rotated = [](double square) {
    return problem_after([=](RobotSpec& r) { r.bodies[2].rotation = {std::sqrt(square), 0.0, 0.0, 0.0}; });
  };
  const auto along = [](double length) {
    return problem_after([=](RobotSpec& r) { r.joints[0].axis = {0.0, length, 0.0}; });
  };
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_EQ(rotated(1.0 + sign * 0.9e-6), "");
    EXPECT_NE(rotated(1.0 + sign * 1.1e-6), "");
    EXPECT_EQ(along(1.0 + sign * 0.9e-6), "");
    EXPECT_NE(along(1.0 + sign * 1.1e-6), "");
  }
}

TEST(CheckRobot, FindsMeshesThatReachBeyondTheirRadiusOrNameCornersThatAreNotThere) {
  const auto problem = [](const std::function<void(Geom&)>& spoil) {
    return problem_after([&](RobotSpec& r) {
      Geom& geom = r.geoms[0];
      geom.shape = Shape::mesh;
      geom.size_m = {0.1, 0, 0};
      geom.vertices_m = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
      geom.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
      spoil(geom);
    });
  };
  const std::string radius = "geom 'torso' must have its vertices within its radius";
  EXPECT_EQ(problem([](Geom& g) { g.vertices_m[3].z = 0.1000001; }), radius);
  EXPECT_EQ(problem([](Geom& g) { g.vertices_m[3].z = nan; }), radius);
  const std::string corner = "geom 'torso' has a triangle with a corner that is not there";
  EXPECT_EQ(problem([](Geom& g) { g.triangles[3][2] = 4; }), corner);
  EXPECT_EQ(problem([](Geom& g) { g.triangles[0][0] = -1; }), corner);
}

TEST(CheckRobot, FindsFeetAndGravityThatCannotBe) {
  expect_refused({[](RobotSpec& r) { r.legs[0].foot_geoms[0] = 4; }},
                 "leg 'A' names a foot that is not there");
  expect_refused({[](RobotSpec& r) { r.legs[0].foot_geoms[0] = 0; }},
                 "leg 'A': its foot 'torso' is on body 'torso', which none of its joints moves");
  expect_refused(
      {[](RobotSpec& r) { r.gravity_m_s2.y = nan; }, [](RobotSpec& r) { r.gravity_m_s2.z = HUGE_VAL; }},
      "gravity must be finite");
  expect_refused({[](RobotSpec& r) { r.fall_height_m = HUGE_VAL; }}, "fall_height_m must be finite");
}

}  // namespace
}  // namespace amble::robot
