#pragma once

#include <string>
#include <vector>

#include "amble/core/math.hpp"
#include "amble/morphology/model_file.hpp"
#include "amble/robot/spec.hpp"

namespace amble::morphology {

/// The parts of a robot that a model file defines. Bodies that are fixed to their parent are one rigid body
/// with it, under the parent's name.
struct ModelParts {
  std::vector<robot::Body> bodies;
  std::vector<robot::Joint> joints;  ///< in the order of the model, without servo
  std::vector<robot::Geom> geoms;
  Vec3 gravity_m_s2;
};

/// Extracts the parts from a compiled model. A geom without a name gets that of its body in the model, with
/// ".0", ".1", … appended where there are several. Left out: geoms of the world (the ground is amble's own)
/// and decorative geoms whose shape amble does not know. Throws UserError for what amble cannot simulate:
/// more than one robot, a root that is not free, joints other than limited hinges, closed loops, tendons,
/// colliding meshes and other shapes, obstacles in the world.
ModelParts extract_parts(const ModelFile& file);

}  // namespace amble::morphology
