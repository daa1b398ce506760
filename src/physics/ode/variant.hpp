#pragma once

#include <vector>

#include "amble/io/own_settings.hpp"

namespace amble::physics::ode {

/// What programs on ODE choose differently, and publications rarely say. With all at 0 it is the engine
/// `ode`, to the bit.
struct Variant {
  /// > 0: dWorldQuickStep with so many sweeps of successive over-relaxation in place of dWorldStep, which
  /// solves exactly. ODE's own default is 20.
  int quick_sweeps = 0;
  /// > 0: friction of each contact is at most this force, N, along each of two directions, however hard it is
  /// pressed: what a finite `mu` is in ODE without dContactApprox1.
  double friction_n = 0.0;
  /// > 0: in contacts of feet, in place of RobotSpec::contact: share of the penetration undone per step, up
  /// to 1, and yielding velocity per force, m/s per N.
  double foot_erp = 0.0;
  double foot_cfm_s_per_kg = 0.0;

  /// From [engine_own] of the engine `ode-variant`; without numbers: all 0.
  static Variant of(const io::OwnSettings& own);
};

/// Its numbers as a config has them.
std::vector<io::OwnNumber> variant_numbers();

}  // namespace amble::physics::ode
