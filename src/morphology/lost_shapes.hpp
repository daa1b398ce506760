#pragma once

#include <map>
#include <string>

struct mjModel_;

namespace amble::morphology {

/// Whether a colliding mesh that could not be read was a foot: the only shape that collides of the last body
/// of a limb that reaches down. What else is lost is left out; without a foot it would be another robot.
/// `missing_meshes`: by MuJoCo's name.
bool is_of_a_foot(const mjModel_& model, int root, int geom,
                  const std::map<std::string, std::string>& missing_meshes);

}  // namespace amble::morphology
