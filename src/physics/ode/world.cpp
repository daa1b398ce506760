#include "amble/physics/ode/world.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/robot/pose.hpp"

namespace amble::physics::ode {
namespace {

using robot::Body;
using robot::Geom;
using robot::Joint;
using robot::Pose;
using robot::RobotSpec;
using robot::Shape;

constexpr double tolerance = 1e-6;

/// Moves a body so that its frame has this pose in the world; ODE's own frame is at the centre of mass.
void set_pose(dBodyID id, const Body& body, const Pose& pose) {
  const Vec3 com = pose * body.com_m;
  const Quat q = pose.rotation;
  const dQuaternion rotation{q.w, q.x, q.y, q.z};
  dBodySetPosition(id, com.x, com.y, com.z);
  dBodySetQuaternion(id, rotation);
}

/// The inertia tensor in the axes of the body's frame, R diag(moments) Rᵀ (kg m²).
dMass mass_of(const Body& body) {
  const std::array<Vec3, 3> axes{rotate(body.inertia_rotation, {1, 0, 0}),
                                 rotate(body.inertia_rotation, {0, 1, 0}),
                                 rotate(body.inertia_rotation, {0, 0, 1})};
  const Vec3 moments = body.inertia_kg_m2;
  const auto element = [&](double Vec3::*r, double Vec3::*c) {
    return moments.x * axes[0].*r * axes[0].*c + moments.y * axes[1].*r * axes[1].*c +
           moments.z * axes[2].*r * axes[2].*c;
  };
  dMass mass;
  dMassSetParameters(&mass, body.mass_kg, 0.0, 0.0, 0.0, element(&Vec3::x, &Vec3::x),
                     element(&Vec3::y, &Vec3::y), element(&Vec3::z, &Vec3::z), element(&Vec3::x, &Vec3::y),
                     element(&Vec3::x, &Vec3::z), element(&Vec3::y, &Vec3::z));
  return mass;
}

dGeomID new_geom(const Geom& geom) {
  const Vec3 size = geom.size_m;
  switch (geom.shape) {
    case Shape::sphere:
      return dCreateSphere(nullptr, size.x);
    case Shape::capsule:
      return dCreateCapsule(nullptr, size.x, 2.0 * size.y);
    case Shape::cylinder:
      return dCreateCylinder(nullptr, size.x, 2.0 * size.y);
    case Shape::box:
      return dCreateBox(nullptr, 2.0 * size.x, 2.0 * size.y, 2.0 * size.z);
  }
  return nullptr;
}

/// A hinge's angle is that of the first attached body against the second.
dJointID new_hinge(dWorldID world, dBodyID parent, dBodyID child, Vec3 anchor, Vec3 axis,
                   const Joint& joint) {
  const dJointID hinge = dJointCreateHinge(world, nullptr);
  dJointAttach(hinge, child, parent);
  dJointSetHingeAnchor(hinge, anchor.x, anchor.y, anchor.z);
  dJointSetHingeAxis(hinge, axis.x, axis.y, axis.z);
  dJointSetHingeParam(hinge, dParamLoStop, joint.lower_rad);
  dJointSetHingeParam(hinge, dParamHiStop, joint.upper_rad);
  return hinge;
}

/// The first axis is fixed to the first attached body, the parent, and the second to the child. ODE measures
/// both angles of the first body against the second, so the axes are reversed to measure the child
/// against the parent.
dJointID new_universal(dWorldID world, dBodyID parent, dBodyID child, Vec3 anchor, Vec3 axis1, Vec3 axis2,
                       const Joint& joint1, const Joint& joint2) {
  const dJointID universal = dJointCreateUniversal(world, nullptr);
  dJointAttach(universal, parent, child);
  dJointSetUniversalAnchor(universal, anchor.x, anchor.y, anchor.z);
  dJointSetUniversalAxis1(universal, -axis1.x, -axis1.y, -axis1.z);
  dJointSetUniversalAxis2(universal, -axis2.x, -axis2.y, -axis2.z);
  dJointSetUniversalParam(universal, dParamLoStop1, joint1.lower_rad);
  dJointSetUniversalParam(universal, dParamHiStop1, joint1.upper_rad);
  dJointSetUniversalParam(universal, dParamLoStop2, joint2.lower_rad);
  dJointSetUniversalParam(universal, dParamHiStop2, joint2.upper_rad);
  return universal;
}

}  // namespace

World::World(const RobotSpec& robot, const Threading& threading) : world_(dWorldCreate()) {
  threading.attach_to(world_);
  dWorldSetGravity(world_, robot.gravity_m_s2.x, robot.gravity_m_s2.y, robot.gravity_m_s2.z);
  dWorldSetAutoDisableFlag(world_, 0);
  // Joints copy these when they are made, so they come first.
  dWorldSetERP(world_, robot.contact.erp);
  dWorldSetCFM(world_, robot.contact.cfm_s_per_kg);
  add_bodies(robot);
  add_joints(robot);
  add_geoms(robot);
}

World::~World() {
  for (const dGeomID geom : geoms_) {
    if (geom != nullptr) dGeomDestroy(geom);
  }
  dGeomDestroy(ground_);
  dWorldDestroy(world_);
}

void World::move_to(const RobotSpec& robot, const std::vector<Pose>& poses) {
  // Joints measure angles from the pose in which they were made, the start pose, so theirs are now right.
  for (std::size_t b = 0; b < bodies_.size(); ++b) set_pose(bodies_[b], robot.bodies[b], poses[b]);
}

void World::add_bodies(const RobotSpec& robot) {
  const std::vector<Pose> poses = robot::start_poses(robot);
  for (std::size_t b = 0; b < robot.bodies.size(); ++b) {
    const dBodyID body = dBodyCreate(world_);
    const dMass mass = mass_of(robot.bodies[b]);
    dBodySetMass(body, &mass);
    set_pose(body, robot.bodies[b], poses[b]);
    bodies_.push_back(body);
  }
}

void World::add_joints(const RobotSpec& robot) {
  const std::vector<Pose> poses = robot::start_poses(robot);
  joints_.assign(robot.bodies.size(), nullptr);
  for (int b = 1; b < static_cast<int>(robot.bodies.size()); ++b) {
    const std::vector<int> chain = robot.joints_of_body(b);
    const dBodyID parent = bodies_[to_index(robot.bodies[to_index(b)].parent)];
    const Pose& pose = poses[to_index(b)];
    const Joint& first = robot.joints[to_index(chain[0])];
    const Vec3 anchor = pose * first.anchor_m;
    const Vec3 axis = rotate(pose.rotation, first.axis);
    if (chain.size() == 1) {
      joints_[to_index(b)] = new_hinge(world_, parent, bodies_[to_index(b)], anchor, axis, first);
    } else {
      const Joint& second = robot.joints[to_index(chain[1])];
      joints_[to_index(b)] = new_universal(world_, parent, bodies_[to_index(b)], anchor, axis,
                                           rotate(pose.rotation, second.axis), first, second);
    }
  }
}

void World::add_geoms(const RobotSpec& robot) {
  ground_ = dCreatePlane(nullptr, 0.0, 0.0, 1.0, 0.0);
  for (const Geom& geom : robot.geoms) {
    if (!geom.collides) {
      geoms_.push_back(nullptr);
      continue;
    }
    const dGeomID id = new_geom(geom);
    const Vec3 offset = geom.position_m - robot.bodies[to_index(geom.body)].com_m;
    const dQuaternion rotation{geom.rotation.w, geom.rotation.x, geom.rotation.y, geom.rotation.z};
    dGeomSetBody(id, bodies_[to_index(geom.body)]);
    dGeomSetOffsetPosition(id, offset.x, offset.y, offset.z);
    dGeomSetOffsetQuaternion(id, rotation);
    geoms_.push_back(id);
  }
}

void check_joints(const RobotSpec& robot) {
  for (int b = 1; b < static_cast<int>(robot.bodies.size()); ++b) {
    const std::string& body = robot.bodies[to_index(b)].name;
    const std::vector<int> chain = robot.joints_of_body(b);
    if (chain.size() > 2) {
      fail(ExitCode::bad_input, "the ode engine cannot put {} joints on body '{}': one or two are possible",
           chain.size(), body);
    }
    if (chain.size() < 2) continue;
    const Joint& first = robot.joints[to_index(chain[0])];
    const Joint& second = robot.joints[to_index(chain[1])];
    if (norm(first.anchor_m - second.anchor_m) > tolerance ||
        std::abs(dot(first.axis, second.axis)) > tolerance) {
      fail(ExitCode::bad_input,
           "the ode engine needs the joints '{}' and '{}' of body '{}' to cross at a right angle", first.name,
           second.name, body);
    }
  }
  for (const Joint& joint : robot.joints) {
    if (joint.lower_rad <= -std::numbers::pi || joint.upper_rad >= std::numbers::pi) {
      fail(ExitCode::bad_input, "the ode engine needs the range of joint '{}' within ± π, not {} … {} rad",
           joint.name, joint.lower_rad, joint.upper_rad);
    }
  }
}

}  // namespace amble::physics::ode
