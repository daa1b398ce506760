#include "amble/robot/doubts.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/robot/legged.hpp"

namespace amble::robot {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A body with one shape, somewhere and turned, whose moments sum up to `moments` times its mass of 2 kg.
RobotSpec body_of(Geom geom, double moments_m2) {
  RobotSpec robot;
  geom.position_m = {0.3, -0.2, 0.1};
  geom.rotation = {std::cos(0.4), 0.0, std::sin(0.4), 0.0};
  const double third = 2.0 * moments_m2 / 3.0;
  robot.bodies.push_back({"body", -1, {}, {}, 2.0, geom.position_m, {third, third, third}, {}});
  robot.geoms.push_back(geom);
  return robot;
}

/// Twice the mean square of the distance from the centre, by points of a lattice.
template <typename Inside>
double moments_by_points(Vec3 half, const Inside& inside) {
  constexpr int n = 60;
  double sum = 0.0, count = 0.0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        const auto at = [](int index, double reach) { return ((index + 0.5) / n * 2.0 - 1.0) * reach; };
        const Vec3 p{at(i, half.x), at(j, half.y), at(k, half.z)};
        if (!inside(p)) continue;
        sum += dot(p, p);
        count += 1.0;
      }
  return 2.0 * sum / count;
}

/// A box as a mesh about a point that is not its centre.
Geom box_mesh(Vec3 half, Vec3 centre) {
  Geom mesh{.name = "mesh", .shape = Shape::mesh, .size_m = {10, 0, 0}, .position_m = {}, .rotation = {}};
  for (int corner = 0; corner < 8; ++corner)
    mesh.vertices_m.push_back(centre + Vec3{corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y,
                                            corner & 4 ? half.z : -half.z});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TEST(Doubts, InertiaIsThatOfEachShapeWithinAFactorOfThree) {
  const auto geom = [](Shape shape, Vec3 size) {
    return Geom{.name = "g", .shape = shape, .size_m = size, .position_m = {}, .rotation = {}};
  };
  const double r = 0.1, h = 0.25;
  const auto round = [&](Vec3 p) { return p.x * p.x + p.y * p.y <= r * r; };
  const auto any = [](Vec3) { return true; };
  const std::pair<Geom, double> shapes[] = {
      {geom(Shape::sphere, {r, 0, 0}),
       moments_by_points({r, r, r}, [&](Vec3 p) { return dot(p, p) <= r * r; })},
      {geom(Shape::box, {0.1, 0.2, 0.3}), moments_by_points({0.1, 0.2, 0.3}, any)},
      {geom(Shape::cylinder, {r, h, 0}), moments_by_points({r, r, h}, round)},
      {geom(Shape::capsule, {r, h, 0}), moments_by_points({r, r, h + r},
                                                          [&](Vec3 p) {
                                                            const double z = std::max(std::abs(p.z) - h, 0.0);
                                                            return p.x * p.x + p.y * p.y + z * z <= r * r;
                                                          })},
  };
  for (const auto& [shape, moments_m2] : shapes) {
    for (const double good : {1.0, 2.95, 1 / 2.95})
      EXPECT_THAT(doubts(body_of(shape, good * moments_m2)), IsEmpty()) << static_cast<int>(shape.shape);
    EXPECT_THAT(doubts(body_of(shape, 3.05 * moments_m2)),
                ElementsAre(HasSubstr("times those of its shapes")));
    EXPECT_THAT(doubts(body_of(shape, moments_m2 / 3.05)),
                ElementsAre(HasSubstr("times those of its shapes")));
  }
  const Geom mesh = box_mesh({0.1, 0.2, 0.3}, {1, 2, 3});
  RobotSpec robot = body_of(mesh, 2.95 * shapes[1].second);
  const Geom& placed = robot.geoms[0];
  robot.bodies[0].com_m = placed.position_m + rotate(placed.rotation, Vec3{1, 2, 3});
  EXPECT_THAT(doubts(robot), IsEmpty());
  robot.bodies[0].inertia_kg_m2 = (3.05 / 2.95) * robot.bodies[0].inertia_kg_m2;
  EXPECT_THAT(doubts(robot), ElementsAre(HasSubstr("body 'body'")));
}

TEST(Doubts, ShapesThatAreNotAllOfABodySayNothing) {
  const Geom foot{
      .name = "foot", .shape = Shape::sphere, .size_m = {0.05, 0, 0}, .position_m = {}, .rotation = {}};
  RobotSpec far = body_of(foot, 1.0);
  EXPECT_THAT(doubts(far), testing::SizeIs(1));
  far.bodies[0].com_m.z += 0.1;
  EXPECT_THAT(doubts(far), IsEmpty());
  RobotSpec dense = body_of(foot, 1.0);
  dense.bodies[0].mass_kg = 5.0;  // 9500 kg/m³
  EXPECT_THAT(doubts(dense), IsEmpty());
  RobotSpec bare = body_of(foot, 1.0);
  bare.geoms.clear();
  EXPECT_THAT(doubts(bare), IsEmpty());
}

TEST(Doubts, MomentsOfABodyLargerThanTheRobotAreNamedInOneLineWhereverItsMassIs) {
  RobotSpec robot = tests::legged_robot(2);
  EXPECT_THAT(doubts(robot), testing::Not(testing::Contains(HasSubstr("larger than the robot"))));
  for (Body& body : robot.bodies) body.inertia_kg_m2 = {1e3, 1e3, 1e3};
  robot.bodies[1].com_m = {0.0, 0.0, 5.0};
  std::size_t named = 0;
  for (const std::string& line : doubts(robot))
    if (line.find("larger than the robot") != std::string::npos) {
      for (const Body& body : robot.bodies)
        named += line.find(body.name + " (3e+03 kg m²") != std::string::npos ? 1 : 0;
      EXPECT_THAT(line, HasSubstr(fmt::format(" and {} more", robot.bodies.size() - 4)));
    }
  EXPECT_EQ(named, 4u);  // the first few, and the others are counted
}

TEST(Doubts, BearingTorqueIsWeightOnHalfOfTheLegsTimesLever) {
  RobotSpec robot = tests::legged_robot(2);
  for (const Leg& leg : robot.legs)
    robot.geoms[static_cast<std::size_t>(leg.foot_geoms[0])].position_m.x = 0.1;
  const double torque_nm = robot.total_mass_kg() * 9.8 / 2 * 0.1;
  const std::vector<double> torques = bearing_torques_nm(robot);
  for (const Leg& leg : robot.legs) {
    EXPECT_NEAR(torques[static_cast<std::size_t>(leg.joints[0])], -torque_nm, 1e-9);  // about +y
    EXPECT_NEAR(torques[static_cast<std::size_t>(leg.joints[1])], -torque_nm, 1e-9);
    EXPECT_NEAR(torques[static_cast<std::size_t>(leg.joints[2])], 0.0, 1e-9);  // the foot is below its axis
  }
  const std::vector<double> stepping = stepping_torques_nm(robot);
  for (std::size_t j = 0; j < stepping.size(); ++j)
    robot.joints[j].servo.max_torque_nm = std::max(std::abs(torques[j]), stepping[j]) + 0.01;
  EXPECT_THAT(doubts(robot), IsEmpty());
  robot.joints[1].servo.max_torque_nm = torque_nm - 0.01;
  EXPECT_THAT(
      doubts(robot),
      ElementsAre(HasSubstr("half of the legs in the start pose: L1_hip_fb (2.15 of 2.16 N m); check")));
  EXPECT_THAT(weak_joints(robot), ElementsAre("L1_hip_fb (2.15 of 2.16 N m)"));
}

TEST(Doubts, StraightLegsNeedTorqueToStep) {
  RobotSpec robot = tests::legged_robot(2);
  const std::vector<double> standing = bearing_torques_nm(robot), stepping = stepping_torques_nm(robot);
  const double weight_n = robot.total_mass_kg() * 9.8 / 2;
  for (const Leg& leg : robot.legs) {
    // The foot is straight below the knee; how far, tells what a step asks of it.
    const auto knee = static_cast<std::size_t>(leg.joints[0]), hip = static_cast<std::size_t>(leg.joints[1]);
    EXPECT_NEAR(standing[knee], 0.0, 1e-9);
    EXPECT_GT(stepping[knee], 0.0);
    EXPECT_GT(stepping[hip], stepping[knee]);
    EXPECT_LT(stepping[hip], 0.25 * weight_n);  // legs shorter than a metre
  }
  for (Joint& joint : robot.joints) joint.servo.max_torque_nm = 0.01;
  EXPECT_THAT(doubts(robot),
              ElementsAre(HasSubstr(
                  "once a foot is a quarter of its leg's length ahead or aside: L1_knee (0.01 of ")));
}

TEST(Doubts, FrictionIsMoreThanThatOfIce) {
  RobotSpec robot = tests::legged_robot(2);
  const auto says = [&](double friction) {
    robot.contact.friction = friction;
    return testing::Matches(testing::Contains(HasSubstr("is less than that of ice")))(doubts(robot));
  };
  EXPECT_TRUE(says(0.0));
  EXPECT_TRUE(says(0.02));
  EXPECT_FALSE(says(0.05));
  EXPECT_FALSE(says(std::numeric_limits<double>::infinity()));
}

TEST(Doubts, MotorsMoveTheirJointsAgainstFrictionDampingAndRotors) {
  const auto says = [](double friction_nm, double damping, double armature, const char* what) {
    RobotSpec robot = tests::legged_robot(2);
    robot.joints[0].servo.max_torque_nm = 5.0;
    robot.joints[0].friction_loss_nm = friction_nm;
    robot.joints[0].damping_nm_s_per_rad = damping;
    robot.joints[0].armature_kg_m2 = armature;
    return testing::Matches(testing::Contains(HasSubstr(what)))(doubts(robot));
  };
  for (const char* what : {"do not overcome the dry friction", "hardly any speed", "rotors so heavy"})
    EXPECT_FALSE(says(1.0, 0.5, 0.1, what)) << what;
  EXPECT_TRUE(says(6.0, 0.0, 0.0, "(5 of 6 N m)"));
  EXPECT_TRUE(says(0.0, 100.0, 0.0, "(0.05 rad/s)"));
  EXPECT_TRUE(says(0.0, 0.0, 5.0, "(1.3 s)"));
}

TEST(Doubts, WheelsDoNotRoll) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const auto says = [](double off_m, double stop_rad) {
    RobotSpec robot = tests::legged_robot(2);
    const auto g = static_cast<std::size_t>(robot.legs[0].foot_geoms.front());
    robot.geoms[g].shape = Shape::sphere;
    robot.geoms[g].size_m = {0.05, 0.0, 0.0};
    for (Joint& joint : robot.joints) {
      if (joint.body != robot.geoms[g].body) continue;
      robot.geoms[g].position_m = joint.anchor_m + Vec3{off_m, 0.0, 0.0};
      joint.lower_rad = -stop_rad;
      joint.upper_rad = stop_rad;
      joint.axis = {0.0, 1.0, 0.0};
    }
    return testing::Matches(testing::Contains(HasSubstr("wheels do not roll")))(doubts(robot));
  };
  EXPECT_TRUE(says(0.0, none));
  EXPECT_FALSE(says(0.1, none));
  EXPECT_FALSE(says(0.0, 1.0));
}

TEST(Doubts, StopsAreInRadians) {
  RobotSpec robot = tests::legged_robot(2);
  const auto says = [&](double lower, double upper) {
    robot.joints[0].lower_rad = lower;
    robot.joints[0].upper_rad = upper;
    return testing::Matches(testing::Contains(HasSubstr("which look like degrees: " + robot.joints[0].name)))(
        doubts(robot));
  };
  constexpr double none = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(says(-60.0, 60.0));
  EXPECT_TRUE(says(-0.5, 90.0));
  EXPECT_FALSE(says(-1.0, 1.0));
  EXPECT_FALSE(says(-12.0, 12.0)) << "nearly two turns";
  EXPECT_FALSE(says(-none, none));
  EXPECT_FALSE(says(-1e9, 1e9)) << "as exporters write no stops";
}

TEST(Doubts, MostJointsThatHardlyMoveHaveRadiansReadAsDegrees) {
  RobotSpec robot = tests::legged_robot(2);
  const auto says = [&] {
    return testing::Matches(testing::Contains(HasSubstr("most joints hardly move: ")))(doubts(robot));
  };
  EXPECT_FALSE(says());
  for (Joint& joint : robot.joints) {
    joint.lower_rad = -0.7 / 57.3;
    joint.upper_rad = 0.7 / 57.3;
  }
  EXPECT_TRUE(says());
  const std::size_t half = robot.joints.size() / 2;
  for (std::size_t j = 0; j < half; ++j) robot.joints[j].upper_rad = 0.7;
  EXPECT_EQ(says(), 2 * half < robot.joints.size()) << "a few may";
}

}  // namespace
}  // namespace amble::robot
