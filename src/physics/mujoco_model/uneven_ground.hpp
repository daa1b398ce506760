#pragma once

#include <vector>

#include "amble/ground/ground.hpp"
#include "amble/physics/mujoco_model/model.hpp"
#include "amble/robot/collision_points.hpp"

namespace amble::physics::mujoco_model {

/// A model's contacts with uneven ground: where ground::Ground finds them, with the friction and softness
/// that MuJoCo would give contacts of the same geoms with the model's own ground.
class UnevenGround {
 public:
  UnevenGround(const robot::RobotSpec& robot, const Model& model);

  /// Lets MuJoCo find contacts with the model's planes z = 0 where `ground` is null, and else not.
  void set_ground(mjModel& model, const ground::Ground* ground) const;
  /// Adds the contacts of the pose in `data`, between mj_collision and mj_makeConstraint. As many as fit.
  void add(const ground::Ground& ground, const mjModel* model, mjData* data);

 private:
  struct Collider {
    int geom = 0;       ///< MuJoCo's number
    robot::Pose place;  ///< in its body's frame
    double radius_m = 0.0;
    std::vector<robot::CollisionPoint> points;
    mjContact contact = {};  ///< with all that does not depend on where it is
  };
  struct Plane {
    int geom = 0, type = 0, affinity = 0;
  };

  std::vector<Collider> colliders_;
  std::vector<Plane> planes_;
  std::vector<ground::Touch> touches_;  ///< of one geom
};

}  // namespace amble::physics::mujoco_model
