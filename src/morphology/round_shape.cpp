#include "amble/morphology/round_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "amble/morphology/convex_hull.hpp"

namespace amble::morphology {
namespace {

/// The apothem of a polygon of twelve corners, as a share of its radius, is 0.966.
constexpr double roundest = 0.96;
/// A ball fills 0.67 of its cylinder, a ball-ended bar up to 0.83, a tyre with round shoulders about 0.88.
constexpr double least_filling = 0.85;
constexpr int directions = 72;

double volume_of(std::span<const Vec3> points_m) {
  constexpr std::size_t corners = 100;
  const ConvexHull hull = convex_hull(points_m, corners);
  double volume = 0.0;
  for (const auto& triangle : hull.triangles) {
    const auto at = [&](std::size_t k) { return hull.vertices_m[static_cast<std::size_t>(triangle[k])]; };
    volume += dot(at(0), cross(at(1), at(2))) / 6.0;
  }
  return volume;
}

/// The turn that takes z to a unit vector.
Quat from_z_to(Vec3 axis) {
  const Quat half{1.0 + axis.z, -axis.y, axis.x, 0.0};
  const double length = std::sqrt(half.w * half.w + half.x * half.x + half.y * half.y);
  if (length < 1e-9) return {0.0, 1.0, 0.0, 0.0};
  return {half.w / length, half.x / length, half.y / length, 0.0};
}

std::optional<RoundShape> about(std::span<const Vec3> points_m, Vec3 axis, double volume_m3) {
  const Quat turn = from_z_to(axis);
  std::vector<Vec3> points;
  points.reserve(points_m.size());
  for (const Vec3 point : points_m) points.push_back(rotate(conjugate(turn), point));
  const auto [low, high] = std::ranges::minmax(points, {}, &Vec3::z);
  // How far the outline reaches in each direction; its mean, weighted by direction, is the centre.
  std::vector<Vec3> ways;
  std::vector<double> reach;
  Vec3 centre{0.0, 0.0, 0.5 * (low.z + high.z)};
  for (int k = 0; k < directions; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / directions;
    ways.push_back({std::cos(angle), std::sin(angle), 0.0});
    double most = -std::numeric_limits<double>::infinity();
    for (const Vec3 point : points) most = std::max(most, dot(ways.back(), point));
    reach.push_back(most);
    centre = centre + (2.0 / directions * most) * ways.back();
  }
  double radius = 0.0, nearest = std::numeric_limits<double>::infinity();
  for (const Vec3 point : points)
    radius = std::max(radius, std::hypot(point.x - centre.x, point.y - centre.y));
  for (std::size_t k = 0; k < ways.size(); ++k)
    nearest = std::min(nearest, reach[k] - dot(ways[k], {centre.x, centre.y, 0.0}));
  const double half_length = 0.5 * (high.z - low.z);
  const double cylinder = 2.0 * std::numbers::pi * radius * radius * half_length;
  if (nearest < roundest * radius || volume_m3 < least_filling * cylinder) return std::nullopt;
  return RoundShape{radius, half_length, {rotate(turn, centre), turn}};
}

}  // namespace

std::optional<RoundShape> cylinder_of(std::span<const Vec3> points_m, std::span<const Vec3> axes) {
  constexpr std::size_t fewest_points = 24;
  if (points_m.size() < fewest_points) return std::nullopt;
  const double volume_m3 = volume_of(points_m);
  if (!(volume_m3 > 0.0)) return std::nullopt;
  for (const Vec3 axis : axes)
    if (const auto shape = about(points_m, axis, volume_m3)) return shape;
  return std::nullopt;
}

}  // namespace amble::morphology
