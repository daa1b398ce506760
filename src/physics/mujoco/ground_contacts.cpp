#include "amble/physics/mujoco/ground_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "amble/core/index.hpp"
#include "amble/morphology/mujoco_math.hpp"

namespace amble::physics::mujoco {
namespace {

constexpr int ground_geom = 0;

}  // namespace

GroundContacts::GroundContacts(const robot::RobotSpec& robot, const Model& model)
    : plane_type_(model.mujoco->geom_contype[ground_geom]),
      plane_affinity_(model.mujoco->geom_conaffinity[ground_geom]) {
  for (std::size_t g = 0; g < model.geom_of.size(); ++g) {
    const int own = model.geom_of[g];
    if (own < 0 || !robot.geoms[to_index(own)].collides) continue;
    const robot::Geom& geom = robot.geoms[to_index(own)];
    Collider collider{.geom = static_cast<int>(g),
                      .place = {geom.position_m, geom.rotation},
                      .points = robot::collision_points(geom)};
    for (const robot::CollisionPoint& point : collider.points)
      collider.radius_m = std::max(collider.radius_m,
                                   std::hypot(norm(point.position_m), point.rim_radius_m) + point.radius_m);
    colliders_.push_back(std::move(collider));
  }
}

void GroundContacts::set_ground(mjModel& model, const ground::Ground* ground) const {
  model.geom_contype[ground_geom] = ground == nullptr ? plane_type_ : 0;
  model.geom_conaffinity[ground_geom] = ground == nullptr ? plane_affinity_ : 0;
}

void GroundContacts::add(const ground::Ground& ground, const mjModel* model, mjData* data) const {
  for (const Collider& collider : colliders_) {
    const int body = model->geom_bodyid[collider.geom];
    const mjtNum* const q = data->xquat + 4 * body;
    const robot::Pose pose =
        robot::Pose{morphology::vec3(data->xpos + 3 * body), {q[0], q[1], q[2], q[3]}} * collider.place;
    if (pose.position_m.z > collider.radius_m + ground.highest_m()) continue;
    const Vec3 up = rotate(conjugate(pose.rotation), {0.0, 0.0, 1.0});
    for (const robot::CollisionPoint& point : collider.points) {
      const ground::Touch touch = ground.touch(pose * robot::position_m(point, up), point.radius_m);
      if (touch.gap_m > 0.0) continue;
      mjContact contact{};
      contact.dist = touch.gap_m;
      // Halfway between the surfaces, as MuJoCo's own.
      const Vec3 n = touch.normal, place_m = touch.point_m - (0.5 * touch.gap_m) * n;
      const double scale = 1.0 / std::hypot(n.y, n.z);
      const Vec3 first{0.0, scale * n.z, -scale * n.y}, second = cross(n, first);
      int i = 0;
      for (const Vec3 axis : {n, first, second})
        for (const double part : {axis.x, axis.y, axis.z}) contact.frame[i++] = part;
      i = 0;
      for (const double part : {place_m.x, place_m.y, place_m.z}) contact.pos[i++] = part;
      const mjtNum* const friction = model->geom_friction + 3 * collider.geom;
      i = 0;
      for (const int kind : {0, 0, 1, 2, 2}) contact.friction[i++] = friction[kind];
      std::copy_n(model->geom_solref + mjNREF * collider.geom, mjNREF, contact.solref);
      std::copy_n(model->geom_solimp + mjNIMP * collider.geom, mjNIMP, contact.solimp);
      contact.dim = model->geom_condim[collider.geom];
      contact.geom1 = ground_geom;
      contact.geom2 = collider.geom;
      contact.efc_address = -1;
      mj_addContact(model, data, &contact);
    }
  }
}

}  // namespace amble::physics::mujoco
