#include "amble/morphology/convex_hull.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <utility>

#include "amble/core/index.hpp"

namespace amble::morphology {
namespace {

std::vector<Vec3> random_points(std::mt19937& random, std::size_t count) {
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  std::vector<Vec3> points(count);
  for (Vec3& point : points) point = {coordinate(random), 0.5 * coordinate(random), 2.0 * coordinate(random)};
  return points;
}

/// Closed, convex, and counter-clockwise from outside.
void expect_sound(const ConvexHull& hull) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : hull.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
    const Vec3 a = hull.vertices_m[to_index(t[0])], b = hull.vertices_m[to_index(t[1])],
               c = hull.vertices_m[to_index(t[2])];
    const Vec3 normal = cross(b - a, c - a);
    for (const Vec3 vertex : hull.vertices_m) EXPECT_LE(dot(normal, vertex - a), 1e-6 * norm(normal));
  }
  for (const auto& [edge, times] : edges) {
    EXPECT_EQ(times, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
  // Euler: faces = 2 vertices − 4.
  EXPECT_EQ(hull.triangles.size(), 2 * hull.vertices_m.size() - 4);
}

TEST(ConvexHull, HoldsAllPointsWhereNoLimitBinds) {
  std::mt19937 random(1);
  for (int repeat = 0; repeat < 200; ++repeat) {
    const std::vector<Vec3> points = random_points(random, 4 + to_index(repeat) / 4);
    const ConvexHull hull = convex_hull(points, 1000);
    expect_sound(hull);
    for (const auto& t : hull.triangles) {
      const Vec3 a = hull.vertices_m[to_index(t[0])];
      const Vec3 normal = cross(hull.vertices_m[to_index(t[1])] - a, hull.vertices_m[to_index(t[2])] - a);
      for (const Vec3 point : points) EXPECT_LE(dot(normal, point - a), 1e-6 * norm(normal));
    }
  }
}

TEST(ConvexHull, KeepsToItsLimitAndNearlyAllOfABall) {
  std::mt19937 random(2);
  std::vector<Vec3> points = random_points(random, 5000);
  for (Vec3& point : points) point = (1.0 / norm(point)) * point;
  const ConvexHull hull = convex_hull(points, 32);
  EXPECT_EQ(hull.vertices_m.size(), 32u);
  expect_sound(hull);
  double volume = 0.0;
  for (const auto& t : hull.triangles)
    volume += dot(hull.vertices_m[to_index(t[0])],
                  cross(hull.vertices_m[to_index(t[1])], hull.vertices_m[to_index(t[2])])) /
              6.0;
  EXPECT_GT(volume, 0.7 * 4.0 / 3.0 * M_PI);
  EXPECT_LT(volume, 4.0 / 3.0 * M_PI);
}

TEST(ConvexHull, OfAGridOfACubeIsTheCube) {
  std::vector<Vec3> points;
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 5; ++y)
      for (int z = 0; z < 5; ++z) points.push_back({0.1 * x, 0.1 * y, 0.1 * z});
  const ConvexHull hull = convex_hull(points, 100);
  expect_sound(hull);
  EXPECT_EQ(hull.vertices_m.size(), 8u);
}

TEST(ConvexHull, IsEmptyWithoutVolume) {
  EXPECT_TRUE(convex_hull({}, 32).triangles.empty());
  std::vector<Vec3> points;
  for (int i = 0; i < 50; ++i) points.push_back({std::cos(0.1 * i), std::sin(0.1 * i), 0.0});
  EXPECT_TRUE(convex_hull(points, 32).triangles.empty());
  for (Vec3& point : points) point = {point.x, 0.0, 0.0};
  EXPECT_TRUE(convex_hull(points, 32).triangles.empty());
}

}  // namespace
}  // namespace amble::morphology
