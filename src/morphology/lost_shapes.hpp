#pragma once

#include <map>
#include <string>

#include "amble/morphology/reading_notes.hpp"

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
