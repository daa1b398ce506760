#include "amble/morphology/model_shapes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace amble::morphology {
namespace {

constexpr std::array<Vec3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// Rings of so many corners about y: radius and place along y of each.
std::vector<Vec3> rings(int corners, const std::vector<std::array<double, 2>>& profile,
                        double turn_rad = 0.0) {
  std::vector<Vec3> points;
  for (const auto& [radius, along] : profile)
    for (int k = 0; k < corners; ++k) {
      const double angle = turn_rad + 2.0 * std::numbers::pi * k / corners;
      points.push_back({0.3 + radius * std::cos(angle), along - 0.1, radius * std::sin(angle)});
    }
  return points;
}

TEST(CylinderOf, AWheelIsTheSameHoweverFarItHasTurned) {
  for (const double turn : {0.0, 0.12, 0.26, 1.0}) {
    const auto shape = cylinder_of(rings(48, {{0.05, -0.02}, {0.05, 0.02}}, turn), axes);
    ASSERT_TRUE(shape);
    EXPECT_NEAR(shape->radius_m, 0.05, 1e-12);
    EXPECT_NEAR(shape->half_length_m, 0.02, 1e-12);
    EXPECT_NEAR(norm(shape->pose.position_m - Vec3{0.3, -0.1, 0.0}), 0.0, 1e-12);
    EXPECT_NEAR(std::abs(rotate(shape->pose.rotation, {0, 0, 1}).y), 1.0, 1e-12);
  }
}

TEST(CylinderOf, ATyreWithRoundShouldersAndAHubIsOne) {
  EXPECT_TRUE(cylinder_of(
      rings(48, {{0.045, -0.02}, {0.05, -0.015}, {0.05, 0.015}, {0.045, 0.02}, {0.01, 0.0}}), axes));
}

TEST(CylinderOf, BallsConesBoxesAndPolygonsAreNone) {
  std::vector<std::array<double, 2>> ball;
  for (int k = 0; k <= 16; ++k)
    ball.push_back({0.05 * std::sin(std::numbers::pi * k / 16), 0.05 * std::cos(std::numbers::pi * k / 16)});
  EXPECT_FALSE(cylinder_of(rings(48, ball), axes));
  EXPECT_FALSE(cylinder_of(rings(48, {{0.05, -0.02}, {0.02, 0.02}}), axes));
  EXPECT_FALSE(cylinder_of(
      rings(4, {{0.05, -0.02}, {0.05, 0.02}, {0.04, 0.0}, {0.03, 0.0}, {0.02, 0.0}, {0.01, 0.0}}), axes));
  EXPECT_FALSE(cylinder_of(rings(8, {{0.05, -0.02}, {0.05, 0.02}, {0.04, 0.0}}), axes));
  EXPECT_FALSE(cylinder_of(rings(48, {{0.05, 0.0}}), axes)) << "a disc without height";
  EXPECT_FALSE(cylinder_of({}, axes));
}

}  // namespace
}  // namespace amble::morphology
