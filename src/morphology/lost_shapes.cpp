#include "amble/morphology/lost_shapes.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/morphology/mujoco_math.hpp"
#include "amble/robot/pose.hpp"

namespace amble::morphology {
namespace {

/// Heights of all bodies in the model's own pose.
std::vector<double> heights_m(const mjModel_& model) {
  std::vector<robot::Pose> poses(to_index(model.nbody));
  std::vector<double> heights(to_index(model.nbody), 0.0);
  for (int b = 1; b < model.nbody; ++b) {
    poses[to_index(b)] = poses[to_index(model.body_parentid[b])] *
                         robot::Pose{vec3(model.body_pos + 3 * b), quat(model.body_quat + 4 * b)};
    heights[to_index(b)] = (poses[to_index(b)] * vec3(model.body_ipos + 3 * b)).z;
  }
  return heights;
}

bool has_children(const mjModel_& model, int body) {
  for (int b = body + 1; b < model.nbody; ++b)
    if (model.body_parentid[b] == body) return true;
  return false;
}

bool is_on_a_limb(const mjModel_& model, int root, int body) {
  for (int b = body; b > root; b = model.body_parentid[b])
    if (model.body_jntnum[b] > 0) return true;
  return false;
}

}  // namespace

bool is_of_a_foot(const mjModel_& model, int root, int geom,
                  const std::map<std::string, std::string>& missing_meshes) {
  const int body = model.geom_bodyid[geom];
  for (int g = model.body_geomadr[body], end = g + model.body_geomnum[body]; g < end; ++g) {
    const bool lost = model.geom_type[g] == mjGEOM_MESH &&
                      missing_meshes.contains(model.names + model.name_meshadr[model.geom_dataid[g]]);
    if (g != geom && !lost && (model.geom_contype[g] != 0 || model.geom_conaffinity[g] != 0)) return false;
  }
  if (has_children(model, body) || !is_on_a_limb(model, root, body)) return false;
  const std::vector<double> heights = heights_m(model);
  double lowest = heights[to_index(body)];
  for (int b = root; b < model.nbody; ++b)
    if (model.body_rootid[b] == root) lowest = std::min(lowest, heights[to_index(b)]);
  constexpr double level_m = 1e-6;
  return heights[to_index(body)] <= 0.5 * (heights[to_index(root)] + lowest) + level_m;
}

}  // namespace amble::morphology
