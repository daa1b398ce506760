#pragma once

#include <span>
#include <vector>

#include "amble/core/math.hpp"
#include "amble/morphology/robot_spec.hpp"

namespace amble::morphology {

/// Where a frame stands in another: a point or frame given in it becomes one of the outer frame.
struct Pose {
  Vec3 position_m;
  Quat rotation;

  Vec3 operator*(Vec3 point_m) const { return position_m + rotate(rotation, point_m); }
  Pose operator*(const Pose& inner) const { return {*this * inner.position_m, rotation * inner.rotation}; }
};

/// Frames of all bodies in the world in the start pose.
std::vector<Pose> start_poses(const RobotSpec& robot);

/// The same with the root's frame at `root` and the joints at these angles (rad, in control order).
std::vector<Pose> poses_at(const RobotSpec& robot, const Pose& root, std::span<const double> angles_rad);

/// Height over the ground (negative: depth) of the lowest point of a geom in the start pose.
double start_clearance_m(const RobotSpec& robot, int geom);
/// Height over the ground of the lowest point of all that collides, with the bodies at `poses`; infinity for
/// a robot of which nothing collides.
double clearance_m(const RobotSpec& robot, std::span<const Pose> poses);

}  // namespace amble::morphology
