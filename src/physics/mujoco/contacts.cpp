#include "amble/physics/mujoco/contacts.hpp"

#include <algorithm>
#include <cmath>

#include "amble/core/index.hpp"
#include "amble/morphology/mujoco_handlers.hpp"

namespace amble::physics::mujoco {
namespace {

constexpr int ground_geom = 0;

/// As MuJoCo makes those of its plane with the geom, whose parameters count.
mjContact contact_of(const ground::Touch& touch, int geom, const mjModel& model) {
  mjContact contact{};
  contact.dist = touch.gap_m;
  const Vec3 n = touch.normal;
  const double scale = 1.0 / std::hypot(n.y, n.z);
  const Vec3 first{0.0, scale * n.z, -scale * n.y}, second = cross(n, first);
  const Vec3 middle_m = touch.point_m - (0.5 * touch.gap_m) * n;  // halfway between the surfaces
  const auto put = [](Vec3 v, mjtNum* to) {
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
  };
  put(middle_m, contact.pos);
  put(n, contact.frame);
  put(first, contact.frame + 3);
  put(second, contact.frame + 6);
  const mjtNum* const friction = model.geom_friction + 3 * geom;  // sliding, spinning, rolling
  int i = 0;
  for (const int kind : {0, 0, 1, 2, 2}) contact.friction[i++] = friction[kind];
  std::copy_n(model.geom_solref + mjNREF * geom, mjNREF, contact.solref);
  std::copy_n(model.geom_solimp + mjNIMP * geom, mjNIMP, contact.solimp);
  contact.dim = model.geom_condim[geom];
  contact.geom1 = ground_geom;
  contact.geom2 = geom;
  contact.efc_address = -1;
  return contact;
}

constexpr int max_corrections = 5;
/// Convergence: the largest change of a normal velocity, m/s.
constexpr double tolerance_m_s = 1e-6;

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
                      .radius_m = robot::bounding_radius_m(geom),
                      .points = robot::collision_points(geom)};
    colliders_.push_back(std::move(collider));
  }
}

void GroundContacts::set_ground(mjModel& model, const ground::Ground* ground) const {
  model.geom_contype[ground_geom] = ground == nullptr ? plane_type_ : 0;
  model.geom_conaffinity[ground_geom] = ground == nullptr ? plane_affinity_ : 0;
}

void GroundContacts::add(const ground::Ground& ground, const mjModel* model, mjData* data) {
  for (const Collider& collider : colliders_) {
    const int body = model->geom_bodyid[collider.geom];
    const mjtNum* const q = data->xquat + 4 * body;
    const robot::Pose pose =
        robot::Pose{morphology::vec3(data->xpos + 3 * body), {q[0], q[1], q[2], q[3]}} * collider.place;
    if (pose.position_m.z > collider.radius_m + ground.highest_m()) continue;
    touches_.clear();
    ground.touches(collider.points, pose, touches_);
    for (const ground::Touch& touch : touches_) {
      const mjContact contact = contact_of(touch, collider.geom, *model);
      mj_addContact(model, data, &contact);
    }
  }
}

Slip::Slip(double friction, double timestep_s) : friction_(friction), timestep_s_(timestep_s) {}

void Slip::solve(const mjModel* model, mjData* data) {
  mj_fwdConstraint(model, data);
  if (friction_ == 0.0 || std::isinf(friction_)) return;
  lowered_.assign(to_index(data->ncon), 0.0);
  for (int i = 0; i < max_corrections && correct(model, data); ++i) mj_fwdConstraint(model, data);
}

/// One step of the fixed-point iteration, a_ref,n ← a_ref,n⁰ − μ |J_t a − a_ref,t| in units of acceleration;
/// false once it has converged.
bool Slip::correct(const mjModel* model, mjData* data) {
  accelerations_.resize(to_index(data->nefc));
  mj_mulJacVec(model, data, accelerations_.data(), data->qacc);
  bool changed = false;
  for (std::size_t c = 0; c < lowered_.size(); ++c) {
    const int row = data->contact[c].efc_address;
    if (row < 0) continue;
    const auto residual = [&](int r) { return accelerations_[to_index(r)] - data->efc_aref[r]; };
    // Tangential rows aim at speed 0 after this step, so what they miss is slip / h.
    const double slip = std::hypot(residual(row + 1), residual(row + 2));
    const double lowered = friction_ * slip;
    changed = changed || std::abs(lowered - lowered_[c]) * timestep_s_ > tolerance_m_s;
    data->efc_aref[row] += lowered_[c] - lowered;
    lowered_[c] = lowered;
  }
  return changed;
}

}  // namespace amble::physics::mujoco
