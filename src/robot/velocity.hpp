#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "amble/core/math.hpp"
#include "amble/robot/pose.hpp"
#include "amble/robot/spec.hpp"

namespace amble::robot {

/// How a body moves, world axes.
struct Twist {
  Vec3 velocity_m_s;  ///< of the origin of its frame
  Vec3 angular_velocity_rad_s;

  /// Velocity of its point at `arm_m` from the origin of its frame, world axes.
  Vec3 of_point(Vec3 arm_m) const { return velocity_m_s + cross(angular_velocity_rad_s, arm_m); }
};

/// Angles (rad) and speeds (rad/s) of all joints, in control order.
struct JointStates {
  std::span<const double> angle_rad, speed_rad_s;
};

/// Twist of a body's frame after the first `hinges` of its joints, those further out being at zero and at
/// rest; `parent` and `parent_twist` are those of its parent's frame. Cf. pose_along().
Twist twist_along(const RobotSpec& robot, int body, const Pose& parent, const Twist& parent_twist,
                  const JointStates& joints, std::size_t hinges);

/// Twists of all bodies, which are at `poses` (poses_at() of these angles).
std::vector<Twist> twists_at(const RobotSpec& robot, std::span<const Pose> poses, const Twist& root,
                             const JointStates& joints);

/// The motion of the whole robot, world axes.
struct WholeMotion {
  Vec3 com_m, com_velocity_m_s;
  Vec3 angular_momentum_kg_m2_s;  ///< about the centre of mass
};
WholeMotion whole_motion(const RobotSpec& robot, std::span<const Pose> poses, std::span<const Twist> twists);

}  // namespace amble::robot
