#include "amble/morphology/body_mass.hpp"

#include <mujoco/mujoco.h>

#include <array>

#include "amble/core/index.hpp"
#include "amble/morphology/mujoco_math.hpp"

namespace amble::morphology {
namespace {

/// Mass, centre and principal moments of several bodies that are fixed to each other (parallel axis
/// theorem).
void combine_masses(const mjModel_& model, const std::vector<int>& members,
                    std::span<const robot::Pose> pose_in_group, robot::Body& body) {
  Vec3 weighted;
  for (const int m : members) {
    body.mass_kg += model.body_mass[m];
    weighted = weighted + model.body_mass[m] * (pose_in_group[to_index(m)] * vec3(model.body_ipos + 3 * m));
  }
  body.com_m = (1.0 / body.mass_kg) * weighted;

  std::array<mjtNum, 9> tensor{};
  for (const int m : members) {
    const robot::Pose own = pose_in_group[to_index(m)] *
                            robot::Pose{vec3(model.body_ipos + 3 * m), quat(model.body_iquat + 4 * m)};
    const Vec3 lever = own.position_m - body.com_m;
    const std::array<Vec3, 3> axes{rotate(own.rotation, {1, 0, 0}), rotate(own.rotation, {0, 1, 0}),
                                   rotate(own.rotation, {0, 0, 1})};
    const std::array<double, 3> d{lever.x, lever.y, lever.z};
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) {
        double moment = model.body_mass[m] * ((r == c ? dot(lever, lever) : 0.0) - d[r] * d[c]);
        for (std::size_t k = 0; k < 3; ++k) {
          const std::array<double, 3> axis{axes[k].x, axes[k].y, axes[k].z};
          moment += model.body_inertia[3 * to_index(m) + k] * axis[r] * axis[c];
        }
        tensor[3 * r + c] += moment;
      }
    }
  }
  std::array<mjtNum, 3> moments{};
  std::array<mjtNum, 9> vectors{};
  std::array<mjtNum, 4> rotation{};
  mju_eig3(moments.data(), vectors.data(), rotation.data(), tensor.data());
  body.inertia_kg_m2 = vec3(moments.data());
  body.inertia_rotation = quat(rotation.data());
}

}  // namespace

void set_mass(const mjModel_& model, const std::vector<int>& members,
              std::span<const robot::Pose> pose_in_group, robot::Body& body) {
  if (members.size() > 1) {
    combine_masses(model, members, pose_in_group, body);
    return;
  }
  const int m = members.front();
  const robot::Pose inertia =
      pose_in_group[to_index(m)] * robot::Pose{vec3(model.body_ipos + 3 * m), quat(model.body_iquat + 4 * m)};
  body.mass_kg = model.body_mass[m];
  body.com_m = inertia.position_m;
  body.inertia_rotation = inertia.rotation;
  body.inertia_kg_m2 = vec3(model.body_inertia + 3 * m);
}

}  // namespace amble::morphology
