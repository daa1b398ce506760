#pragma once

#include <mujoco/mujoco.h>

#include <vector>

namespace amble::physics::mujoco {

/// Coulomb's law for feet that slip. MuJoCo's contact forces minimise a convex cost, whose optimum lifts a
/// contact that slips at speed s off the ground, at the speed friction × s (Todorov 2014, "Convex and
/// analytically-invertible dynamics with contacts and constraints"); at time steps of 0.01 s a slipping foot
/// would hop. The cure is that of De Saxcé and Feng 1998 and Cadoux 2009: lower the normal velocity that the
/// solver aims at by just that much, and repeat until s is that of the solution.
class Slip {
 public:
  /// Infinite friction needs no cure.
  Slip(double friction, double timestep_s);

  /// Does what mj_fwdConstraint does.
  void solve(const mjModel* model, mjData* data);

 private:
  bool correct(const mjModel* model, mjData* data);

  double friction_, timestep_s_;
  std::vector<double> accelerations_;  ///< by constraint row: J qacc
  std::vector<double> lowered_;        ///< by contact, m/s²
};

}  // namespace amble::physics::mujoco
