#pragma once

#include <mujoco/mujoco.h>

#include "amble/physics/engine.hpp"

namespace amble::physics::mujoco_model {

/// Velocity of the origin of the root's frame, and its angular velocity, world axes.
struct RootMotion {
  Vec3 velocity_m_s, angular_velocity_rad_s;
};

/// How a robot's root hangs in the world of its own model: by a free joint, or by slides and hinges, as
/// planar walkers do (morphology::moves_as_root); then it moves no further than these let it.
class Root {
 public:
  Root() = default;
  Root(const mjModel& model, int body);

  int body() const { return body_; }
  /// Its first degree of freedom in qvel, and how many there are.
  int dof() const { return dof_; }
  int dofs() const { return dofs_; }
  int position() const { return position_; }  ///< likewise its first number in qpos
  bool is_free() const { return free_; }

  /// Puts it there as far as its joints let it: on hinges, the turn about each axis in their order; on
  /// slides, what then is left along each. Other joints in `data` stay; computes the positions of bodies.
  void place(const mjModel* model, const RootPose& pose, mjData* data) const;
  /// Sets its speeds likewise. After place(), or other positions of bodies.
  void move(const mjModel* model, Vec3 velocity_m_s, Vec3 angular_velocity_rad_s, mjData* data) const;

  /// A free root's is in qpos itself; that of others is as the positions of bodies were computed last.
  RootPose pose(const mjData& data) const;
  RootMotion motion(const mjModel* model, mjData* data) const;

 private:
  int body_ = 1, joint_ = 0, joints_ = 1;
  int position_ = 0, dof_ = 0, dofs_ = 6;
  bool free_ = true;
};

}  // namespace amble::physics::mujoco_model
