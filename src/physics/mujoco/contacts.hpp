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

/// Coulomb's law for feet that slip. MuJoCo's contact forces minimise a convex cost, at whose optimum a
/// contact that slips at speed s separates at the speed v_n = friction × s (Todorov 2014, "Convex and
/// analytically-invertible dynamics with contacts and constraints"); at time steps of 0.01 s a slipping foot
/// would hop. Remedy of De Saxcé and Feng 1998 and Cadoux 2009: lower the normal velocity that the solver
/// aims at by friction × s, and repeat as a fixed-point iteration until s is that of the solution.
class Slip {
 public:
  /// With infinite or zero friction nothing is corrected.
  Slip(double friction, double timestep_s);

  /// In place of mj_fwdConstraint.
  void solve(const mjModel* model, mjData* data);

 private:
  bool correct(const mjModel* model, mjData* data);

  double friction_, timestep_s_;
  std::vector<double> accelerations_;  ///< by constraint row: J qacc
  std::vector<double> lowered_;        ///< by contact: present correction of the normal row's efc_aref, m/s²
};

}  // namespace amble::physics::mujoco
