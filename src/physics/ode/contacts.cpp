#include "amble/physics/ode/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "amble/core/index.hpp"

namespace amble::physics::ode {
namespace {

using robot::Geom;
using robot::RobotSpec;
using robot::Shape;

/// How far a mesh's corners are from ODE's centre of it, or from its origin: the larger.
double mesh_radius(const Geom& geom) {
  const Vec3 centre = mesh_centre(geom);
  double radius_m = geom.size_m.x;
  for (const Vec3 vertex : geom.vertices_m) radius_m = std::max(radius_m, norm(vertex - centre));
  return radius_m;
}

double bounding_radius(const Geom& geom) {
  const Vec3 size = geom.size_m;
  switch (geom.shape) {
    case Shape::sphere:
      return size.x;
    case Shape::mesh:
      return mesh_radius(geom);
    case Shape::capsule:
      return size.x + size.y;
    case Shape::cylinder:
      return std::hypot(size.x, size.y);
    case Shape::box:
      return norm(size);
  }
  return 0.0;
}

bool joined(const RobotSpec& robot, int a, int b) {
  return a == b || robot.bodies[to_index(a)].parent == b || robot.bodies[to_index(b)].parent == a;
}

/// Friction as the robot and the variant have it.
dSurfaceParameters surface_of(const RobotSpec& robot, const Variant& variant) {
  // Coulomb friction |f_t| ≤ μ f_n along each of two directions, a pyramid; without dContactApprox1 mu is a
  // bound of the force itself, so infinity means sticking (ODE manual, "Contact").
  dSurfaceParameters surface{};
  if (variant.friction_n > 0.0) {
    surface.mu = variant.friction_n;
  } else {
    surface.mode = std::isinf(robot.contact.friction) ? 0 : dContactApprox1;
    surface.mu = std::isinf(robot.contact.friction) ? dInfinity : robot.contact.friction;
  }
  return surface;
}

dSurfaceParameters softened(dSurfaceParameters surface, const Variant& variant) {
  if (variant.foot_erp > 0.0) surface.mode |= dContactSoftERP;
  if (variant.foot_cfm_s_per_kg > 0.0) surface.mode |= dContactSoftCFM;
  surface.soft_erp = variant.foot_erp;
  surface.soft_cfm = variant.foot_cfm_s_per_kg;
  return surface;
}

/// Margin of a bounding sphere for rounding, m.
constexpr double slack_m = 1e-6;

}  // namespace

Contacts::Contacts(const RobotSpec& robot, const World& world, const ground::Ground* ground, bool loads,
                   const Variant& variant)
    : world_(world),
      ground_(ground),
      group_(dJointGroupCreate(0)),
      with_loads_(loads),
      surface_(surface_of(robot, variant)),
      foot_surface_(softened(surface_, variant)) {
  std::vector<int> body_of;
  for (std::size_t g = 0; g < robot.geoms.size(); ++g) {
    const Geom& geom = robot.geoms[g];
    if (!geom.collides) continue;
    Collider collider{.geom = world.geoms()[g],
                      .body = world.bodies()[to_index(geom.body)],
                      .radius_m = bounding_radius(geom) + slack_m};
    for (std::size_t l = 0; l < robot.legs.size(); ++l) {
      if (robot.legs[l].has_foot_geom(static_cast<int>(g))) collider.leg = static_cast<int>(l);
    }
    if (ground_ != nullptr) {
      collider.place = {geom.position_m - robot.bodies[to_index(geom.body)].com_m, geom.rotation};
      collider.points = robot::collision_points(geom);
    }
    colliders_.push_back(std::move(collider));
    body_of.push_back(geom.body);
  }
  if (!robot.self_collision) return;
  for (std::size_t a = 0; a < colliders_.size(); ++a) {
    for (std::size_t b = a + 1; b < colliders_.size(); ++b) {
      if (!joined(robot, body_of[a], body_of[b]))
        pairs_.push_back({static_cast<int>(a), static_cast<int>(b)});
    }
  }
}

Contacts::~Contacts() {
  dJointGroupDestroy(group_);
}

void Contacts::find_touch(LaneArray& touch) {
  touch.set_lane(0, 0.0f);
  for (const Collider& collider : colliders_)
    if (collider.leg >= 0 && collide_with_ground(collider) > 0) touch.at(collider.leg, 0) = 1.0f;
}

void Contacts::collide(LaneArray& touch) {
  dJointGroupEmpty(group_);
  feedbacks_.clear();
  touch.set_lane(0, 0.0f);
  for (const Collider& collider : colliders_) {
    const int count = collide_with_ground(collider);
    add_contacts(count, collider.body, nullptr, collider.leg);
    if (collider.leg >= 0 && count > 0) touch.at(collider.leg, 0) = 1.0f;
  }
  for (const Pair& pair : pairs_) collide_pair(pair);
}

int Contacts::collide_with_ground(const Collider& collider) {
  if (ground_ != nullptr) return collide_with_uneven_ground(collider);
  if (dGeomGetPosition(collider.geom)[2] > collider.radius_m) return 0;
  return dCollide(collider.geom, world_.ground(), most_contacts, found_, sizeof(dContactGeom));
}

/// The contacts of ground::Ground; if there are too many, the deepest.
int Contacts::collide_with_uneven_ground(const Collider& collider) {
  const dReal* const com = dBodyGetPosition(collider.body);
  const dReal* const q = dBodyGetQuaternion(collider.body);
  const robot::Pose pose = robot::Pose{{com[0], com[1], com[2]}, {q[0], q[1], q[2], q[3]}} * collider.place;
  if (pose.position_m.z > collider.radius_m + ground_->highest_m()) return 0;
  touches_.clear();
  ground_->touches(collider.points, pose, touches_);
  if (touches_.size() > most_contacts) {
    std::ranges::stable_sort(touches_, {}, &ground::Touch::gap_m);
    touches_.resize(most_contacts);
  }
  for (std::size_t c = 0; c < touches_.size(); ++c) {
    const auto& [gap_m, normal, point_m] = touches_[c];
    found_[c] = {.pos = {point_m.x, point_m.y, point_m.z, 0.0},
                 .normal = {normal.x, normal.y, normal.z, 0.0},
                 .depth = -gap_m,
                 .g1 = collider.geom,
                 .g2 = world_.ground(),
                 .side1 = -1,
                 .side2 = -1};
  }
  return static_cast<int>(touches_.size());
}

void Contacts::collide_pair(const Pair& pair) {
  const Collider& a = colliders_[to_index(pair.a)];
  const Collider& b = colliders_[to_index(pair.b)];
  const dReal* at = dGeomGetPosition(a.geom);
  const dReal* bt = dGeomGetPosition(b.geom);
  const Vec3 between{at[0] - bt[0], at[1] - bt[1], at[2] - bt[2]};
  const double reach = a.radius_m + b.radius_m;
  if (dot(between, between) > reach * reach) return;
  add_contacts(dCollide(a.geom, b.geom, most_contacts, found_, sizeof(dContactGeom)), a.body, b.body, -1);
}

void Contacts::loads(LaneArray& loads_n) const {
  loads_n.set_lane(0, 0.0f);
  for (const Feedback& feedback : feedbacks_) {
    const dReal* const f = feedback.forces.f1;
    loads_n.at(feedback.leg, 0) += static_cast<float>(dot({f[0], f[1], f[2]}, feedback.normal));
  }
}

void Contacts::add_contacts(int count, dBodyID a, dBodyID b, int leg) {
  for (int c = 0; c < count; ++c) {
    // Normal row: v_n⁺ + cfm f_n = (erp/h) depth, f_n ≥ 0, with the world's erp and cfm unless the
    // surface has its own.
    dContact contact{};
    contact.surface = leg < 0 ? surface_ : foot_surface_;
    contact.geom = found_[c];
    const dJointID joint = dJointCreateContact(world_.id(), group_, &contact);
    dJointAttach(joint, a, b);
    if (!with_loads_ || leg < 0) continue;
    const dReal* const n = contact.geom.normal;
    Feedback& feedback = feedbacks_.emplace_back(Feedback{.leg = leg, .normal = {n[0], n[1], n[2]}});
    dJointSetFeedback(joint, &feedback.forces);
  }
}

}  // namespace amble::physics::ode
