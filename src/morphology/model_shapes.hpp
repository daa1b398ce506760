#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>

#include "amble/morphology/reading_notes.hpp"
#include "amble/robot/pose.hpp"
#include "amble/robot/spec.hpp"

namespace amble::morphology {

/// A cylinder about its z axis: half its length is size_m.y.
struct RoundShape {
  double radius_m = 0.0, half_length_m = 0.0;
  robot::Pose pose;
};

/// The cylinder that points are the corners of, if they are: a wheel. About one of these axes (unit vectors)
/// their outline is a circle, at least as much as a polygon of twelve corners is, and their hull fills most
/// of the cylinder.
std::optional<RoundShape> cylinder_of(std::span<const Vec3> points_m, std::span<const Vec3> axes);

}  // namespace amble::morphology

struct mjModel_;

namespace amble::morphology {

/// Whether a body of the world can be a robot's root in the engine mujoco-model: it moves by a free joint, or
/// by slides and hinges alone.
bool moves_as_root(const mjModel_& model, int body);

/// Whether a geom can touch the ground: its contype or conaffinity is not 0, or a <pair> joins it with a geom
/// of another tree of bodies, such as the floor.
bool collides(const mjModel_& model, int geom);

/// Whether a geom is the ground: a plane z = 0 that collides and stands still in the world, in whatever
/// bodies.
bool is_ground(const mjModel_& model, int geom);

/// Shape and size of a geom of the model; of meshes and ellipsoids the convex hull, with its vertices, of
/// colliding meshes that are round about an axis the cylinder. Its pose is within the geom's frame; names and
/// colour are the caller's. Nothing for shapes that robots do not have (planes, height fields) and
/// for meshes without volume.
std::optional<robot::Geom> shape_of(const mjModel_& model, int geom, bool collides);

}  // namespace amble::morphology

struct mjModel_;

namespace amble::morphology {

/// Whether a small tetrahedron stands for a geom's mesh, which could not be read. `missing_meshes`: by
/// MuJoCo's name.
bool is_placeholder(const mjModel_& model, int geom,
                    const std::map<std::string, std::string>& missing_meshes);

/// Whether a body is the last one of a limb that reaches down.
bool ends_a_leg(const mjModel_& model, int root, int body);

/// Whether a colliding mesh that could not be read was (part of) a foot: the last body of a limb that reaches
/// down has no shape that collides and lies lower. What else is lost is left out; without a foot it would be
/// another robot. `missing_meshes`: by MuJoCo's name.
bool is_of_a_foot(const mjModel_& model, int root, int geom,
                  const std::map<std::string, std::string>& missing_meshes);

/// If no shape of any body collides, all shapes do that there are to look at: else the robot would fall
/// through the ground.
void let_visuals_collide(mjModel_& model, ReadingNotes& notes);

}  // namespace amble::morphology
