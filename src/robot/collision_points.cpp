#include "amble/robot/collision_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace amble::robot {
namespace {

constexpr double third_of_a_turn = 2.0 * std::numbers::pi / 3.0;

}  // namespace

std::vector<CollisionPoint> collision_points(const Geom& geom) {
  const Vec3 size = geom.size_m;
  std::vector<CollisionPoint> points;
  switch (geom.shape) {
    case Shape::sphere:
      points.push_back({.position_m = {}, .radius_m = size.x});
      break;
    case Shape::capsule:
      for (const double end : {-size.y, size.y})
        points.push_back({.position_m = {0.0, 0.0, end}, .radius_m = size.x});
      break;
    case Shape::box:
      for (int corner = 0; corner < 8; ++corner)
        points.push_back({.position_m = {corner & 1 ? size.x : -size.x, corner & 2 ? size.y : -size.y,
                                         corner & 4 ? size.z : -size.z}});
      break;
    case Shape::mesh:
      points.reserve(geom.vertices_m.size());
      for (const Vec3 vertex : geom.vertices_m) points.push_back({.position_m = vertex});
      break;
    case Shape::cylinder:
      for (const double end : {-size.y, size.y})
        for (const double angle : {0.0, third_of_a_turn, -third_of_a_turn})
          points.push_back({.position_m = {0.0, 0.0, end}, .rim_radius_m = size.x, .rim_angle_rad = angle});
      break;
  }
  return points;
}

Vec3 position_m(const CollisionPoint& point, Vec3 up) {
  if (point.rim_radius_m == 0.0) return point.position_m;
  // Down along the rim: −up without its part along the axis z. Upright, every point of the rim is as low.
  const double square = up.x * up.x + up.y * up.y;
  const bool upright = square < 1e-8;
  const double scale = upright ? 0.0 : 1.0 / std::sqrt(square);
  const Vec3 lowest = upright ? Vec3{1.0, 0.0, 0.0} : Vec3{-scale * up.x, -scale * up.y, 0.0};
  const Vec3 aside{-lowest.y, lowest.x, 0.0};
  return point.position_m + point.rim_radius_m * (std::cos(point.rim_angle_rad) * lowest +
                                                  std::sin(point.rim_angle_rad) * aside);
}

double bounding_radius_m(const Geom& geom) {
  double radius_m = 0.0;
  for (const CollisionPoint& point : collision_points(geom))
    radius_m = std::max(radius_m, std::hypot(norm(point.position_m), point.rim_radius_m) + point.radius_m);
  return radius_m;
}

std::vector<double> contact_radii_m(const RobotSpec& robot) {
  std::vector<double> radii{0.0};
  for (const Geom& geom : robot.geoms)
    if (geom.collides)
      for (const CollisionPoint& point : collision_points(geom)) radii.push_back(point.radius_m);
  std::ranges::sort(radii);
  radii.erase(std::unique(radii.begin(), radii.end()), radii.end());
  return radii;
}

}  // namespace amble::robot
