#include "amble/physics/mujoco_model/uneven_ground.hpp"

#include <algorithm>
#include <cmath>

#include "amble/core/index.hpp"
#include "amble/morphology/mujoco_handlers.hpp"

namespace amble::physics::mujoco_model {
namespace {

/// What MuJoCo gives a contact of two geoms (documentation, "Contact parameters"): of the one with the higher
/// priority; else the larger friction and dimension, and solref and solimp mixed by solmix.
mjContact parameters(const mjModel& m, int ground, int geom) {
  mjContact contact{};
  const int ids[] = {ground, geom};
  const int priority = m.geom_priority[ground] - m.geom_priority[geom];
  double weight = 0.5;  // of the ground's
  const double mix0 = m.geom_solmix[ground], mix1 = m.geom_solmix[geom];
  if (priority != 0)
    weight = priority > 0 ? 1.0 : 0.0;
  else if (mix0 >= mjMINVAL && mix1 >= mjMINVAL)
    weight = mix0 / (mix0 + mix1);
  else if (mix0 >= mjMINVAL || mix1 >= mjMINVAL)
    weight = mix0 >= mjMINVAL ? 1.0 : 0.0;
  const auto larger = [&](const auto* numbers, int width, int at) {
    const auto first = numbers[width * ids[0] + at], second = numbers[width * ids[1] + at];
    return priority > 0 ? first : priority < 0 ? second : std::max(first, second);
  };
  const auto mixed = [&](const mjtNum* numbers, int width, int at) {
    return weight * numbers[width * ids[0] + at] + (1.0 - weight) * numbers[width * ids[1] + at];
  };
  int i = 0;
  for (const int kind : {0, 0, 1, 2, 2}) contact.friction[i++] = larger(m.geom_friction, 3, kind);
  contact.dim = larger(m.geom_condim, 1, 0);
  const bool standard = m.geom_solref[mjNREF * ground] > 0 && m.geom_solref[mjNREF * geom] > 0;
  for (int k = 0; k < mjNREF; ++k)  // stiffness and damping, written as negative numbers, are not mixed
    contact.solref[k] = standard || priority != 0
                            ? mixed(m.geom_solref, mjNREF, k)
                            : std::min(m.geom_solref[mjNREF * ground + k], m.geom_solref[mjNREF * geom + k]);
  for (int k = 0; k < mjNIMP; ++k) contact.solimp[k] = mixed(m.geom_solimp, mjNIMP, k);
  const double margin = std::max(m.geom_margin[ground], m.geom_margin[geom]);
  contact.includemargin = margin - std::max(m.geom_gap[ground], m.geom_gap[geom]);
  contact.geom1 = ground;
  contact.geom2 = geom;
  contact.efc_address = -1;
  return contact;
}

void put_where(const ground::Touch& touch, mjContact& contact) {
  contact.dist = touch.gap_m;
  const Vec3 n = touch.normal;
  const double scale = 1.0 / std::hypot(n.y, n.z);
  const Vec3 first{0.0, scale * n.z, -scale * n.y}, second = cross(n, first);
  const Vec3 middle_m = touch.point_m - (0.5 * touch.gap_m) * n;  // halfway between the surfaces
  mjtNum* to = contact.pos;
  for (const Vec3 v : {middle_m, n, first, second}) {
    const mjtNum numbers[] = {v.x, v.y, v.z};
    std::ranges::copy(numbers, to);
    to = to == contact.pos ? contact.frame : to + 3;
  }
}

}  // namespace

UnevenGround::UnevenGround(const robot::RobotSpec& robot, const Model& model) {
  const mjModel& m = *model.mujoco;
  for (const int g : model.grounds) planes_.push_back({g, m.geom_contype[g], m.geom_conaffinity[g]});
  if (planes_.empty()) return;
  for (std::size_t g = 0; g < robot.geoms.size(); ++g) {
    if (!robot.geoms[g].collides) continue;
    const int id = robot.original->geoms[g];
    if (id >= m.ngeom) continue;
    colliders_.push_back(
        {.geom = id,
         .place = {morphology::vec3(m.geom_pos + 3 * id), morphology::quat(m.geom_quat + 4 * id)},
         .radius_m = robot::bounding_radius_m(robot.geoms[g]),
         .points = robot::collision_points(robot.geoms[g]),
         .contact = parameters(m, planes_.front().geom, id)});
  }
}

void UnevenGround::set_ground(mjModel& model, const ground::Ground* ground) const {
  for (const Plane& plane : planes_) {
    model.geom_contype[plane.geom] = ground == nullptr ? plane.type : 0;
    model.geom_conaffinity[plane.geom] = ground == nullptr ? plane.affinity : 0;
  }
}

void UnevenGround::add(const ground::Ground& ground, const mjModel* model, mjData* data) {
  for (Collider& collider : colliders_) {
    const int body = model->geom_bodyid[collider.geom];
    const robot::Pose pose =
        robot::Pose{morphology::vec3(data->xpos + 3 * body), morphology::quat(data->xquat + 4 * body)} *
        collider.place;
    if (pose.position_m.z > collider.radius_m + ground.highest_m()) continue;
    touches_.clear();
    ground.touches(collider.points, pose, touches_);
    for (const ground::Touch& touch : touches_) {
      put_where(touch, collider.contact);
      mj_addContact(model, data, &collider.contact);
    }
  }
}

}  // namespace amble::physics::mujoco_model
