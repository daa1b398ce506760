#include "amble/ground/ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"

namespace amble::ground {
namespace {

/// Calls `visit` with centre, m, and radius, m, of each ball by which the robot touches the ground.
template <typename Visit>
void for_each_ball(const robot::RobotSpec& robot, std::span<const robot::Pose> poses, const Visit& visit) {
  for (const robot::Geom& geom : robot.geoms) {
    if (!geom.collides) continue;
    const robot::Pose pose = poses[to_index(geom.body)] * robot::Pose{geom.position_m, geom.rotation};
    const Vec3 up = rotate(conjugate(pose.rotation), {0.0, 0.0, 1.0});
    for (const robot::CollisionPoint& point : robot::collision_points(geom))
      visit(pose * robot::position_m(point, up), point.radius_m);
  }
}

/// The highest node of a square around a place, `reach_m` from its middle to its sides, or just outside it.
float highest_within(const HeightField& surface, double x_m, double y_m, double reach_m) {
  constexpr double all = HeightField::cells;
  const double count = std::ceil(2.0 * reach_m / surface.cell_m()) + 2.0;
  if (count >= all) return surface.highest_m();
  // Whole periods are taken off first, so that any finite place fits into an int.
  const auto first = [&](double at_m) {
    const double node = std::floor((at_m - reach_m) / surface.cell_m());
    return static_cast<int>(node - all * std::floor(node / all));
  };
  const int left = first(x_m), front = first(y_m), nodes = static_cast<int>(count);
  float highest_m = surface.node(left, front);
  for (int j = front; j < front + nodes; ++j)
    for (int i = left; i < left + nodes; ++i) highest_m = std::max(highest_m, surface.node(i, j));
  return highest_m;
}

}  // namespace

Ground::Ground(HeightField surface, const robot::RobotSpec& robot)
    : radii_m_(robot::contact_radii_m(robot)), highest_m_(surface.highest_m()) {
  fields_.reserve(radii_m_.size());
  for (const double radius_m : radii_m_) fields_.push_back(offset_field(surface, radius_m));
}

std::size_t Ground::field_of(double radius_m) const {
  const auto found = std::ranges::lower_bound(radii_m_, radius_m);
  AMBLE_CHECK(found != radii_m_.end() && *found == radius_m, "a radius of the robot");
  return to_index(found - radii_m_.begin());
}

Touch Ground::touch(Vec3 centre_m, double radius_m) const {
  const auto [height_m, slope_x, slope_y] = fields_[field_of(radius_m)].at(centre_m.x, centre_m.y);
  const double up = 1.0 / std::sqrt(1.0 + slope_x * slope_x + slope_y * slope_y);
  const Vec3 normal{-up * slope_x, -up * slope_y, up};
  return {.gap_m = up * (centre_m.z - height_m), .normal = normal, .point_m = centre_m - radius_m * normal};
}

void Ground::touches(std::span<const robot::CollisionPoint> points, const robot::Pose& pose,
                     std::vector<Touch>& found) const {
  const Vec3 up = rotate(conjugate(pose.rotation), {0.0, 0.0, 1.0});
  for (const robot::CollisionPoint& point : points) {
    const Touch at = touch(pose * robot::position_m(point, up), point.radius_m);
    if (at.gap_m <= 0.0) found.push_back(at);
  }
}

double Ground::clearance_m(const robot::RobotSpec& robot, std::span<const robot::Pose> poses) const {
  double clearance_m = std::numeric_limits<double>::infinity();
  for_each_ball(robot, poses, [&](Vec3 centre_m, double radius_m) {
    const HeightField& field = fields_[field_of(radius_m)];
    clearance_m = std::min(clearance_m, centre_m.z - field.at(centre_m.x, centre_m.y).height_m);
  });
  return clearance_m;
}

double least_clearance_m(const HeightField& surface, const robot::RobotSpec& robot,
                         std::span<const robot::Pose> poses) {
  double clearance_m = std::numeric_limits<double>::infinity();
  for_each_ball(robot, poses, [&](Vec3 centre_m, double radius_m) {
    // Between nodes heights are those of a cell's corners: once of the surface, once of its offset field.
    const double highest_m =
        highest_within(surface, centre_m.x, centre_m.y, radius_m + 2.0 * surface.cell_m());
    clearance_m = std::min(clearance_m, centre_m.z - radius_m - highest_m);
  });
  return clearance_m;
}

}  // namespace amble::ground
