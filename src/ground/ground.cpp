#include "amble/ground/ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"

namespace amble::ground {

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
  for (const robot::Geom& geom : robot.geoms) {
    if (!geom.collides) continue;
    const robot::Pose pose = poses[to_index(geom.body)] * robot::Pose{geom.position_m, geom.rotation};
    const Vec3 up = rotate(conjugate(pose.rotation), {0.0, 0.0, 1.0});
    for (const robot::CollisionPoint& point : robot::collision_points(geom)) {
      const Vec3 centre_m = pose * robot::position_m(point, up);
      const HeightField& field = fields_[field_of(point.radius_m)];
      clearance_m = std::min(clearance_m, centre_m.z - field.at(centre_m.x, centre_m.y).height_m);
    }
  }
  return clearance_m;
}

}  // namespace amble::ground
