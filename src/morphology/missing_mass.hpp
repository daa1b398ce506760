#pragma once

#include <array>
#include <set>
#include <span>
#include <vector>

#include "amble/morphology/model_text.hpp"
#include "amble/morphology/reading_notes.hpp"
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

struct mjModel_;

namespace amble::morphology {

/// Sets mass, centre and principal moments of a rigid body that consists of these bodies of the model (at
/// least one); `pose_in_group`: the pose of each of the model's bodies in the rigid body's frame.
void set_mass(const mjModel_& model, const std::vector<int>& members,
              std::span<const robot::Pose> pose_in_group, robot::Body& body);

}  // namespace amble::morphology

struct mjModel_;

namespace amble::morphology {

/// Gives bodies whose mass or moments are missing those of their shapes, of those that collide if there are
/// any: with the mass that the file gives, else filled with water; without shapes those of a ball of water of
/// that mass. Without a mass remain what has no shape, and what is welded to a body that has a mass in the
/// file, as a URDF's links without <inertial> often are. Bodies that weigh what their geoms do, where a mesh
/// of these could not be read, keep the mass and get moments. Moments that would need a body larger than the
/// robot become those of the shapes, too. `text`: what the model was compiled from. Returns the bodies that
/// were changed, by MuJoCo's number.
std::set<int> mend_masses(mjModel_& model, const ModelText& text, ReadingNotes& notes);

}  // namespace amble::morphology
