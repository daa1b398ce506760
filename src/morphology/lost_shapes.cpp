#include "amble/morphology/lost_shapes.hpp"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/morphology/model_shapes.hpp"
#include "amble/morphology/mujoco_math.hpp"
#include "amble/robot/pose.hpp"

namespace amble::morphology {
namespace {

/// Of all bodies in the model's own pose.
std::vector<robot::Pose> poses_of(const mjModel_& model) {
  std::vector<robot::Pose> poses(to_index(model.nbody));
  for (int b = 1; b < model.nbody; ++b)
    poses[to_index(b)] = poses[to_index(model.body_parentid[b])] *
                         robot::Pose{vec3(model.body_pos + 3 * b), quat(model.body_quat + 4 * b)};
  return poses;
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

bool is_placeholder(const mjModel_& model, int geom,
                    const std::map<std::string, std::string>& missing_meshes) {
  return model.geom_type[geom] == mjGEOM_MESH &&
         missing_meshes.contains(model.names + model.name_meshadr[model.geom_dataid[geom]]);
}

bool ends_a_leg(const mjModel_& model, int root, int body) {
  if (has_children(model, body) || !is_on_a_limb(model, root, body)) return false;
  const std::vector<robot::Pose> poses = poses_of(model);
  const auto height_m = [&](int b) { return (poses[to_index(b)] * vec3(model.body_ipos + 3 * b)).z; };
  double lowest = height_m(body);
  for (int b = root; b < model.nbody; ++b)
    if (model.body_rootid[b] == root) lowest = std::min(lowest, height_m(b));
  constexpr double level_m = 1e-6;
  return height_m(body) <= 0.5 * (height_m(root) + lowest) + level_m;
}

bool is_of_a_foot(const mjModel_& model, int root, int geom,
                  const std::map<std::string, std::string>& missing_meshes) {
  const int body = model.geom_bodyid[geom];
  if (!ends_a_leg(model, root, body)) return false;
  const robot::Pose pose = poses_of(model)[to_index(body)];
  const auto height_m = [&](int g) { return (pose * vec3(model.geom_pos + 3 * g)).z; };
  // The placeholder's centre, of which its height is known, is that far beside the mesh's origin.
  constexpr double placeholder_m = 1e-3;
  for (int g = model.body_geomadr[body], end = g + model.body_geomnum[body]; g < end; ++g) {
    if (!is_placeholder(model, g, missing_meshes) && collides(model, g) &&
        height_m(g) < height_m(geom) - placeholder_m)
      return false;
  }
  return true;
}

void let_visuals_collide(mjModel_& model, ReadingNotes& notes) {
  std::vector<int> shapes;
  for (int g = 0; g < model.ngeom; ++g) {
    if (model.geom_bodyid[g] == 0) continue;
    if (collides(model, g)) return;
    shapes.push_back(g);
  }
  if (shapes.empty()) return;
  for (const int g : shapes) model.geom_contype[g] = model.geom_conaffinity[g] = 1;
  notes.add(Reading::replaced,
            fmt::format("that nothing of the robot collides: its {} shapes to look at do", shapes.size()));
}

}  // namespace amble::morphology
