#pragma once

#include "amble/core/math.hpp"
#include "amble/robot/spec.hpp"

namespace amble::damage {

/// Adds a point mass at `at_m`, in the body's frame: the body's mass, centre of mass and inertia become those
/// of both.
void add_point_mass(robot::Body& body, double mass_kg, Vec3 at_m);

}  // namespace amble::damage
