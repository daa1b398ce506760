#pragma once

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

/// Height over the ground (negative: depth) of the lowest point of a geom in the start pose.
double start_clearance_m(const RobotSpec& robot, int geom);

}  // namespace amble::morphology
