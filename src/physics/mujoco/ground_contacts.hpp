#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "amble/ground/ground.hpp"
#include "amble/physics/mujoco/model.hpp"
#include "amble/robot/collision_points.hpp"
#include "amble/robot/spec.hpp"

namespace amble::physics::mujoco {

/// A robot's contacts with uneven ground, those of ground::Ground in place of MuJoCo's own with its plane.
class GroundContacts {
 public:
  GroundContacts(const robot::RobotSpec& robot, const Model& model);

  /// Lets MuJoCo find contacts with its plane where `ground` is null, and else not.
  void set_ground(mjModel& model, const ground::Ground* ground) const;
  /// Adds the contacts of the pose in `data`, between mj_collision and mj_makeConstraint. As many as fit.
  void add(const ground::Ground& ground, const mjModel* model, mjData* data);

 private:
  struct Collider {
    int geom = 0;           ///< MuJoCo's id
    robot::Pose place;      ///< in its body's frame (MuJoCo's own has other axes for meshes)
    double radius_m = 0.0;  ///< of a sphere about its centre that encloses it
    std::vector<robot::CollisionPoint> points;
  };

  std::vector<Collider> colliders_;
  std::vector<ground::Touch> touches_;  ///< of one geom
  int plane_type_, plane_affinity_;     ///< of MuJoCo's plane
};

}  // namespace amble::physics::mujoco
