#include "amble/physics/mujoco/slip.hpp"

#include <cmath>

#include "amble/core/index.hpp"

namespace amble::physics::mujoco {
namespace {

constexpr int max_corrections = 5;
/// Convergence: the largest change of a normal velocity, m/s.
constexpr double tolerance_m_s = 1e-6;

}  // namespace

Slip::Slip(double friction, double timestep_s) : friction_(friction), timestep_s_(timestep_s) {}

void Slip::solve(const mjModel* model, mjData* data) {
  mj_fwdConstraint(model, data);
  if (friction_ == 0.0 || std::isinf(friction_)) return;
  lowered_.assign(to_index(data->ncon), 0.0);
  for (int i = 0; i < max_corrections && correct(model, data); ++i) mj_fwdConstraint(model, data);
}

/// One step of the fixed-point iteration, a_ref,n ← a_ref,n⁰ − μ |J_t a − a_ref,t| in units of acceleration;
/// false once it has converged.
bool Slip::correct(const mjModel* model, mjData* data) {
  accelerations_.resize(to_index(data->nefc));
  mj_mulJacVec(model, data, accelerations_.data(), data->qacc);
  bool changed = false;
  for (std::size_t c = 0; c < lowered_.size(); ++c) {
    const int row = data->contact[c].efc_address;
    if (row < 0) continue;
    const auto residual = [&](int r) { return accelerations_[to_index(r)] - data->efc_aref[r]; };
    // Tangential rows aim at speed 0 after this step, so what they miss is slip / h.
    const double slip = std::hypot(residual(row + 1), residual(row + 2));
    const double lowered = friction_ * slip;
    changed = changed || std::abs(lowered - lowered_[c]) * timestep_s_ > tolerance_m_s;
    data->efc_aref[row] += lowered_[c] - lowered;
    lowered_[c] = lowered;
  }
  return changed;
}

}  // namespace amble::physics::mujoco
