#pragma once

#include <optional>

#include "amble/robot/spec.hpp"

struct mjModel_;

namespace amble::morphology {

/// Whether a geom can touch the ground: its contype or conaffinity is not 0, or a <pair> joins it with a geom
/// of another tree of bodies, such as the floor.
bool collides(const mjModel_& model, int geom);

/// Shape and size of a geom of the model; of meshes and ellipsoids the convex hull, with its vertices, of
/// colliding meshes that are round about an axis the cylinder. Its pose is within the geom's frame; names and
/// colour are the caller's. Nothing for shapes that robots do not have (planes, height fields) and
/// for meshes without volume.
std::optional<robot::Geom> shape_of(const mjModel_& model, int geom, bool collides);

}  // namespace amble::morphology
