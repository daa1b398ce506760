#pragma once

#include <span>
#include <vector>

#include "amble/core/math.hpp"
#include "amble/robot/spec.hpp"

namespace amble::robot {

/// Pose of a frame in an outer frame; the product maps points and frames given in it to the outer frame.
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

/// Pose of a body's frame after the first `hinges` of its joints, those further out being at zero; `parent`
/// is the pose of its parent's frame.
Pose pose_along(const RobotSpec& robot, int body, const Pose& parent, std::span<const double> angles_rad,
                std::size_t hinges);

/// Centre of mass of the whole robot in the start pose, in the world.
Vec3 start_com_m(const RobotSpec& robot);

/// Centre of a geom in the world, with the bodies at `poses`.
Vec3 centre_m(const Geom& geom, std::span<const Pose> poses);
/// Height over the ground (negative: depth) of a geom's lowest point, with the bodies at `poses`.
double bottom_m(const Geom& geom, std::span<const Pose> poses);

/// The same in the start pose.
double start_clearance_m(const RobotSpec& robot, int geom);
/// Height over the ground of the lowest point of all that collides, with the bodies at `poses`; infinity for
/// a robot of which nothing collides.
double clearance_m(const RobotSpec& robot, std::span<const Pose> poses);

}  // namespace amble::robot
