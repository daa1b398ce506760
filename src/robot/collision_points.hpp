#pragma once

#include <vector>

#include "amble/core/math.hpp"
#include "amble/robot/spec.hpp"

namespace amble::robot {

/// A ball (or, with radius 0, a corner) of a geom that can touch the ground; or a point of a cylinder's rim:
/// of each rim three, the lowest and those a third of the circle from it, which carry a cylinder that stands
/// upright. In the geom's frame.
struct CollisionPoint {
  Vec3 position_m;             ///< of a rim: its centre
  double radius_m = 0.0;       ///< of the ball
  double rim_radius_m = 0.0;   ///< 0: no rim
  double rim_angle_rad = 0.0;  ///< from the lowest point, about the cylinder's axis
};

/// A sphere's centre, a capsule's ends, a box's corners, a hull's vertices, a cylinder's rims.
std::vector<CollisionPoint> collision_points(const Geom& geom);

/// Where a point is in the geom's frame, in which `up` (a unit vector) points upwards.
Vec3 position_m(const CollisionPoint& point, Vec3 up);

/// Radius of a ball about the geom's centre that encloses all of its collision points, m.
double bounding_radius_m(const Geom& geom);

/// The different radii of all balls and corners of a robot that collide, rising; always with 0.
std::vector<double> contact_radii_m(const RobotSpec& robot);

}  // namespace amble::robot
