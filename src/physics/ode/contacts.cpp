#include "amble/physics/ode/contacts.hpp"

#include <cmath>

#include "amble/core/index.hpp"

namespace amble::physics::ode {
namespace {

using robot::Geom;
using robot::RobotSpec;
using robot::Shape;

double bounding_radius(const Geom& geom) {
  const Vec3 size = geom.size_m;
  switch (geom.shape) {
    case Shape::sphere:
    case Shape::mesh:
      return size.x;
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

/// Margin of a bounding sphere for rounding, m.
constexpr double slack_m = 1e-6;

}  // namespace

Contacts::Contacts(const RobotSpec& robot, const World& world) : world_(world), group_(dJointGroupCreate(0)) {
  // Coulomb friction |f_t| ≤ μ f_n along each of two directions, a pyramid; without dContactApprox1 mu would
  // be a bound of the force itself, so infinity means sticking (ODE manual, "Contact").
  surface_.mode = std::isinf(robot.contact.friction) ? 0 : dContactApprox1;
  surface_.mu = std::isinf(robot.contact.friction) ? dInfinity : robot.contact.friction;

  std::vector<int> body_of;
  for (std::size_t g = 0; g < robot.geoms.size(); ++g) {
    const Geom& geom = robot.geoms[g];
    if (!geom.collides) continue;
    Collider collider{.geom = world.geoms()[g],
                      .body = world.bodies()[to_index(geom.body)],
                      .radius_m = bounding_radius(geom) + slack_m};
    for (std::size_t l = 0; l < robot.legs.size(); ++l) {
      if (robot.legs[l].foot_geom == static_cast<int>(g)) collider.leg = static_cast<int>(l);
    }
    colliders_.push_back(collider);
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
  for (const Collider& collider : colliders_) {
    if (collider.leg >= 0) touch.at(collider.leg, 0) = collide_with_ground(collider) > 0 ? 1.0f : 0.0f;
  }
}

void Contacts::collide(LaneArray& touch) {
  dJointGroupEmpty(group_);
  for (const Collider& collider : colliders_) {
    const int count = collide_with_ground(collider);
    add_contacts(count, collider.body, nullptr);
    if (collider.leg >= 0) touch.at(collider.leg, 0) = count > 0 ? 1.0f : 0.0f;
  }
  for (const Pair& pair : pairs_) collide_pair(pair);
}

int Contacts::collide_with_ground(const Collider& collider) {
  if (dGeomGetPosition(collider.geom)[2] > collider.radius_m) return 0;
  return dCollide(collider.geom, world_.ground(), most_contacts, found_, sizeof(dContactGeom));
}

void Contacts::collide_pair(const Pair& pair) {
  const Collider& a = colliders_[to_index(pair.a)];
  const Collider& b = colliders_[to_index(pair.b)];
  const dReal* at = dGeomGetPosition(a.geom);
  const dReal* bt = dGeomGetPosition(b.geom);
  const Vec3 between{at[0] - bt[0], at[1] - bt[1], at[2] - bt[2]};
  const double reach = a.radius_m + b.radius_m;
  if (dot(between, between) > reach * reach) return;
  add_contacts(dCollide(a.geom, b.geom, most_contacts, found_, sizeof(dContactGeom)), a.body, b.body);
}

void Contacts::add_contacts(int count, dBodyID a, dBodyID b) {
  for (int c = 0; c < count; ++c) {
    // Normal row: v_n⁺ + cfm f_n = (erp/h) depth, f_n ≥ 0, with the world's erp and cfm.
    dContact contact{};
    contact.surface = surface_;
    contact.geom = found_[c];
    dJointAttach(dJointCreateContact(world_.id(), group_, &contact), a, b);
  }
}

}  // namespace amble::physics::ode
