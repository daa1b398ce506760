#pragma once

#include <array>

#include "amble/robot/pose.hpp"
#include "amble/robot/spec.hpp"

namespace amble::morphology {

/// Shapes filled evenly: volume, ∫ r dV and ∫ r rᵀ dV (row by row) about an origin.
struct Solid {
  double volume_m3 = 0.0;
  Vec3 first_m4 = {};
  std::array<double, 9> second_m5 = {};

  Vec3 centre_m() const { return volume_m3 > 0.0 ? (1.0 / volume_m3) * first_m4 : Vec3{}; }
  /// Tensor of inertia about its centre, row by row, with this mass.
  std::array<double, 9> inertia_kg_m2(double mass_kg) const;
};

/// Adds a shape whose frame has this pose about the origin.
void add(Solid& solid, const robot::Geom& geom, const robot::Pose& pose);

}  // namespace amble::morphology
