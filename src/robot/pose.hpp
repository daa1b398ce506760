#pragma once

#include <span>
#include <vector>

#include "amble/core/math.hpp"
#include "amble/robot/spec.hpp"

namespace amble::robot {

/// Pose of a frame in an outer frame; the product maps points and frames given in it to the outer frame.
struct Pose {
  Vec3 position_m;  ///< the frame's origin, in the outer frame
  Quat rotation;    ///< the frame's axes → the outer frame's

  /// The point, given in this frame, as the outer frame has it.
  Vec3 operator*(Vec3 point_m) const { return position_m + rotate(rotation, point_m); }
  /// The frame `inner`, given in this one, as the outer frame has it.
  Pose operator*(const Pose& inner) const { return {*this * inner.position_m, rotation * inner.rotation}; }
};

/// Frames of all bodies in the world in the start pose, in the order of RobotSpec::bodies.
std::vector<Pose> start_poses(const RobotSpec& robot);

/// The same with the root's frame at `root` and the joints at these angles: one for each of
/// RobotSpec::joints, in that order (AMBLE_CHECK); they may lie beyond the stops.
std::vector<Pose> poses_at(const RobotSpec& robot, const Pose& root, std::span<const double> angles_rad);

/// Pose of a body's frame after the first `hinges` of its joints, those further out being at zero; `parent`
/// is the pose of its parent's frame, `angles_rad` are those of all joints.
Pose pose_along(const RobotSpec& robot, int body, const Pose& parent, std::span<const double> angles_rad,
                std::size_t hinges);

/// Centre of mass of the whole robot in the start pose, in the world.
Vec3 start_com_m(const RobotSpec& robot);
/// Whether a robot with this centre of mass begins elsewhere than at `start_com_m`, by more than engines
/// round.
bool starts_elsewhere(Vec3 com_m, Vec3 start_com_m);

/// Centre of a geom in the world, with the bodies at `poses` (all of them, as poses_at() gives them).
Vec3 centre_m(const Geom& geom, std::span<const Pose> poses);
/// Height over the plane z = 0 (negative: depth) of a geom's lowest point, with the bodies at `poses`.
double bottom_m(const Geom& geom, std::span<const Pose> poses);

/// The same in the start pose; `geom` is an index in RobotSpec::geoms.
double start_clearance_m(const RobotSpec& robot, int geom);
/// Height over the plane z = 0 of the lowest point of all that collides, with the bodies at `poses`; infinity
/// for a robot of which nothing collides.
double clearance_m(const RobotSpec& robot, std::span<const Pose> poses);

}  // namespace amble::robot
