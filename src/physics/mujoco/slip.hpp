#pragma once

#include <mujoco/mujoco.h>

#include <vector>

namespace amble::physics::mujoco {

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
