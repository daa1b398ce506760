#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "amble/morphology/robot_file.hpp"
#include "amble/robot/pose.hpp"

namespace amble::morphology {
namespace {

robot::RobotSpec quadruped(const std::string& variant) {
  return load_robot(std::string(AMBLE_SOURCE_DIR "/robots/quadruped/") + variant + ".toml");
}

class Quadruped : public testing::TestWithParam<const char*> {
 protected:
  robot::RobotSpec robot_ = quadruped(GetParam());
};

TEST_P(Quadruped, HasItsJointsInControlOrder) {
  const std::vector<std::string> legs{"FL", "FR", "BL", "BR"};
  const std::vector<std::string> types{"knee", "hip_fb", "hip_io"};
  EXPECT_EQ(robot_.joint_types, types);
  ASSERT_EQ(robot_.legs.size(), 4u);
  ASSERT_EQ(robot_.joints.size(), 12u);
  for (std::size_t l = 0; l < 4; ++l) {
    EXPECT_EQ(robot_.legs[l].name, legs[l]);
    EXPECT_EQ(robot_.geoms[static_cast<std::size_t>(robot_.legs[l].foot_geoms[0])].name, legs[l] + "_foot");
    for (std::size_t t = 0; t < 3; ++t) EXPECT_EQ(robot_.joints[3 * l + t].name, legs[l] + "_" + types[t]);
  }
}

TEST_P(Quadruped, HasTheRangesAndAxesOfTheConventions) {
  for (std::size_t l = 0; l < 4; ++l) {
    const bool front = l < 2;
    const bool left = l % 2 == 0;
    const robot::Joint& knee = robot_.joints[3 * l];
    const robot::Joint& forward_backward = robot_.joints[3 * l + 1];
    const robot::Joint& in_out = robot_.joints[3 * l + 2];
    EXPECT_EQ(knee.lower_rad, front ? -0.8 : 0.0);
    EXPECT_EQ(knee.upper_rad, front ? 0.0 : 0.8);
    EXPECT_EQ(knee.axis, (Vec3{0.0, 1.0, 0.0}));
    EXPECT_EQ(forward_backward.lower_rad, -0.8);
    EXPECT_EQ(forward_backward.upper_rad, 0.8);
    EXPECT_EQ(forward_backward.axis, (Vec3{0.0, 1.0, 0.0}));
    EXPECT_EQ(in_out.lower_rad, 0.0);
    EXPECT_EQ(in_out.upper_rad, 0.4);
    EXPECT_EQ(in_out.axis, (Vec3{left ? 1.0 : -1.0, 0.0, 0.0}));
    // The hip's first axis is fixed to the torso, its second to the leg.
    EXPECT_EQ(robot_.joints_of_body(in_out.body),
              (std::vector<int>{static_cast<int>(3 * l + 2), static_cast<int>(3 * l + 1)}));
  }
}

TEST_P(Quadruped, StartsUprightWithItsFeetOnTheGround) {
  const auto poses = robot::start_poses(robot_);
  EXPECT_EQ(poses[0].position_m, (Vec3{0.0, 0.0, 0.88404}));
  for (std::size_t l = 0; l < 4; ++l) {
    const int foot = robot_.legs[l].foot_geoms[0];
    const robot::Geom& geom = robot_.geoms[static_cast<std::size_t>(foot)];
    const Vec3 at = poses[static_cast<std::size_t>(geom.body)] * geom.position_m;
    EXPECT_NEAR(at.x, l < 2 ? 0.43333 : -0.43333, 1e-12);
    EXPECT_NEAR(at.y, l % 2 == 0 ? 0.2833 : -0.2833, 1e-12);
    EXPECT_NEAR(robot::start_clearance_m(robot_, foot), -1e-4, 1e-12);
    EXPECT_EQ(geom.size_m.x, 0.0917);
  }
}

TEST_P(Quadruped, HasTheMassesAndTheMotorsOfTheAuthors) {
  EXPECT_EQ(robot_.bodies.size(), 9u);
  EXPECT_NEAR(robot_.total_mass_kg(), 5.4, 1e-12);
  EXPECT_EQ(robot_.bodies[0].mass_kg, 1.0);
  EXPECT_EQ(robot_.gravity_m_s2, (Vec3{0.0, 0.0, -9.8}));
  EXPECT_EQ(robot_.fall_height_m, 0.467);
  EXPECT_FALSE(robot_.self_collision);
  EXPECT_EQ(robot_.contact.erp, 0.1);
  EXPECT_EQ(robot_.contact.cfm_s_per_kg, 1e-4);
  for (const robot::Joint& joint : robot_.joints) {
    EXPECT_EQ(joint.servo.mode, robot::ServoMode::velocity);
    EXPECT_EQ(joint.servo.gain_per_s, 9.0);
    EXPECT_EQ(joint.servo.max_torque_nm, 5.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Variants, Quadruped, testing::Values("authors", "paper"),
                         [](const auto& variant) { return std::string(variant.param); });

TEST(AuthorsQuadruped, HasATorsoOfUnitInertiaAndInfiniteFriction) {
  const robot::RobotSpec robot = quadruped("authors");
  EXPECT_EQ(robot.bodies[0].inertia_kg_m2, (Vec3{1.0, 1.0, 1.0}));
  EXPECT_TRUE(std::isinf(robot.contact.friction));
}

TEST(AuthorsQuadruped, HasLowerLegsOfABoxAndASphere) {
  // Box 0.1 × 0.1 × 0.35 of 0.5 kg at −0.175185, sphere of 0.1 kg and radius 0.0917 at −0.44207: moments by
  // hand.
  const double com = -(0.5 * 0.175185 + 0.1 * 0.44207) / 0.6;
  const double sphere = 0.4 * 0.1 * 0.0917 * 0.0917;
  const double across = 0.5 * (0.01 + 0.1225) / 12 + 0.5 * std::pow(-0.175185 - com, 2) + sphere +
                        0.1 * std::pow(-0.44207 - com, 2);
  const double along = 0.5 * 0.02 / 12 + sphere;
  const robot::Body lower = quadruped("authors").bodies[2];
  EXPECT_NEAR(lower.com_m.z, com, 1e-12);
  EXPECT_NEAR(lower.inertia_kg_m2.x, across, 1e-12);
  EXPECT_NEAR(lower.inertia_kg_m2.y, across, 1e-12);
  EXPECT_NEAR(lower.inertia_kg_m2.z, along, 1e-12);
}

TEST(PaperQuadruped, HasASolidTorsoAndFiniteFriction) {
  const robot::RobotSpec robot = quadruped("paper");
  const Vec3 moments = robot.bodies[0].inertia_kg_m2;
  const std::multiset<double> found{moments.x, moments.y, moments.z};
  const std::vector<double> sorted(found.begin(), found.end());
  EXPECT_NEAR(sorted[0], (0.43 * 0.43 + 0.40 * 0.40) / 12, 1e-12);
  EXPECT_NEAR(sorted[1], (1.17 * 1.17 + 0.40 * 0.40) / 12, 1e-12);
  EXPECT_NEAR(sorted[2], (1.17 * 1.17 + 0.43 * 0.43) / 12, 1e-12);
  EXPECT_EQ(robot.contact.friction, 1.0);
}

}  // namespace
}  // namespace amble::morphology
