#include "amble/physics/ode/world.hpp"

#include <array>
#include <cmath>
#include <cstdarg>
#include <mutex>
#include <numbers>
#include <vector>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/robot/pose.hpp"

namespace amble::physics::ode {
namespace {

void ignore_message(int, const char*, va_list) {}

[[noreturn]] void throw_fault(int, const char* message, va_list) {
  throw Fault(message);
}

void initialise_process() {
  AMBLE_CHECK(dInitODE2(0) != 0, "dInitODE2");
  dSetMessageHandler(ignore_message);
  dSetErrorHandler(throw_fault);
  dSetDebugHandler(throw_fault);
}

/// Keeps an implementation that cannot be freed any more until the process ends.
void abandon(dThreadingImplementationID implementation) {
  static std::mutex mutex;
  static auto* const abandoned = new std::vector<dThreadingImplementationID>;  // outlives every engine
  const std::lock_guard lock(mutex);
  abandoned->push_back(implementation);
}

using robot::Body;
using robot::Geom;
using robot::Joint;
using robot::Pose;
using robot::RobotSpec;
using robot::Shape;

constexpr double tolerance = 1e-6;
/// Mass and inertia of a body between two hinges, relative to the body behind them.
constexpr double intermediate_share = 1e-3;

/// Moves a body so that its frame has this pose in the world; ODE's own frame is at the centre of mass.
void set_pose(dBodyID id, const Body& body, const Pose& pose) {
  const Vec3 com = pose * body.com_m;
  const Quat q = pose.rotation;
  const dQuaternion rotation{q.w, q.x, q.y, q.z};
  dBodySetPosition(id, com.x, com.y, com.z);
  dBodySetQuaternion(id, rotation);
}

void set_velocity(dBodyID id, const Body& body, const Pose& pose, const robot::Twist& twist) {
  const Vec3 v = twist.of_point(rotate(pose.rotation, body.com_m)), w = twist.angular_velocity_rad_s;
  dBodySetLinearVel(id, v.x, v.y, v.z);
  dBodySetAngularVel(id, w.x, w.y, w.z);
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

/// About `centre`, because ODE takes a polygon whose corners turn clockwise about the origin for faulty.
ConvexArrays convex_arrays(const Geom& geom, Vec3 centre) {
  ConvexArrays arrays;
  for (const Vec3 vertex : geom.vertices_m)
    for (const double x : {vertex.x - centre.x, vertex.y - centre.y, vertex.z - centre.z})
      arrays.points.push_back(x);
  for (const auto& [a, b, c] : geom.triangles) {
    const auto corner = [&](int vertex) { return geom.vertices_m[to_index(vertex)] - centre; };
    const Vec3 normal = cross(corner(b) - corner(a), corner(c) - corner(a));
    const Vec3 unit = (1.0 / norm(normal)) * normal;
    for (const double x : {unit.x, unit.y, unit.z, dot(unit, corner(a))}) arrays.planes.push_back(x);
    for (const int entry : {3, a, b, c}) arrays.polygons.push_back(static_cast<unsigned>(entry));
  }
  return arrays;
}

dGeomID new_convex(const ConvexArrays& arrays) {
  return dCreateConvex(nullptr, arrays.planes.data(), static_cast<unsigned>(arrays.planes.size() / 4),
                       arrays.points.data(), static_cast<unsigned>(arrays.points.size() / 3),
                       arrays.polygons.data());
}

/// A shape that is not a mesh.
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
    case Shape::mesh:
      break;
  }
  return nullptr;
}

/// Whether ODE can watch the joint's stops itself: it knows angles from −π to π.
bool has_stops_within_a_turn(const Joint& joint) {
  return joint.lower_rad > -std::numbers::pi && joint.upper_rad < std::numbers::pi;
}

/// A hinge's angle is that of the first attached body against the second.
dJointID new_hinge(dWorldID world, dBodyID parent, dBodyID child, Vec3 anchor, Vec3 axis,
                   const Joint& joint) {
  const dJointID hinge = dJointCreateHinge(world, nullptr);
  dJointAttach(hinge, child, parent);
  dJointSetHingeAnchor(hinge, anchor.x, anchor.y, anchor.z);
  dJointSetHingeAxis(hinge, axis.x, axis.y, axis.z);
  if (has_stops_within_a_turn(joint)) {
    dJointSetHingeParam(hinge, dParamLoStop, joint.lower_rad);
    dJointSetHingeParam(hinge, dParamHiStop, joint.upper_rad);
  }
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

bool are_universal(const RobotSpec& robot, const std::vector<int>& joints) {
  if (joints.size() != 2) return false;
  const Joint& first = robot.joints[to_index(joints[0])];
  const Joint& second = robot.joints[to_index(joints[1])];
  return norm(first.anchor_m - second.anchor_m) <= tolerance &&
         std::abs(dot(first.axis, second.axis)) <= tolerance && has_stops_within_a_turn(first) &&
         has_stops_within_a_turn(second);
}

}  // namespace

void prepare_thread() {
  static std::once_flag once;
  std::call_once(once, initialise_process);
  thread_local const bool ready = dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll)) != 0;
  AMBLE_CHECK(ready, "dAllocateODEDataForThread");
}

Threading::Threading() : implementation_(dThreadingAllocateSelfThreadedImplementation()) {}

Threading::~Threading() {
  dThreadingFreeImplementation(implementation_);
}

void Threading::attach_to(dWorldID world) const {
  dWorldSetStepThreadingImplementation(world, dThreadingImplementationGetFunctions(implementation_),
                                       implementation_);
}

void Threading::replace() {
  abandon(implementation_);
  implementation_ = dThreadingAllocateSelfThreadedImplementation();
}

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

void World::move_to(const RobotSpec& robot, const Pose& root, std::span<const double> angles_rad) {
  // Joints measure angles from the pose in which they were made, the start pose, so theirs are now right.
  const std::vector<Pose> poses = robot::poses_at(robot, root, angles_rad);
  for (std::size_t b = 0; b < bodies_.size(); ++b) set_pose(bodies_[b], robot.bodies[b], poses[b]);
  for (const auto& [id, body, hinges] : intermediates_) {
    const Body& its = robot.bodies[to_index(body)];
    set_pose(id, its, robot::pose_along(robot, body, poses[to_index(its.parent)], angles_rad, hinges));
  }
}

void World::set_velocities(const RobotSpec& robot, const Pose& root, const robot::Twist& root_twist,
                           const robot::JointStates& joints) {
  const std::vector<Pose> poses = robot::poses_at(robot, root, joints.angle_rad);
  const std::vector<robot::Twist> twists = robot::twists_at(robot, poses, root_twist, joints);
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    set_velocity(bodies_[b], robot.bodies[b], poses[b], twists[b]);
  for (const auto& [id, body, hinges] : intermediates_) {
    const Body& its = robot.bodies[to_index(body)];
    const std::size_t parent = to_index(its.parent);
    set_velocity(id, its, robot::pose_along(robot, body, poses[parent], joints.angle_rad, hinges),
                 robot::twist_along(robot, body, poses[parent], twists[parent], joints, hinges));
  }
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
  for (int b = 1; b < static_cast<int>(robot.bodies.size()); ++b) {
    const std::vector<int> chain = robot.joints_of_body(b);
    const Pose& pose = poses[to_index(b)];
    if (!are_universal(robot, chain)) {
      add_hinges(robot, b, chain, pose);
      continue;
    }
    const Joint& first = robot.joints[to_index(chain[0])];
    const Joint& second = robot.joints[to_index(chain[1])];
    const dBodyID parent = bodies_[to_index(robot.bodies[to_index(b)].parent)];
    bearings_.push_back(
        {new_universal(world_, parent, bodies_[to_index(b)], pose * first.anchor_m,
                       rotate(pose.rotation, first.axis), rotate(pose.rotation, second.axis), first, second),
         chain[0], chain[1]});
  }
}

void World::add_hinges(const RobotSpec& robot, int body, const std::vector<int>& joints, const Pose& pose) {
  const Body& its = robot.bodies[to_index(body)];
  const dBodyID last = bodies_[to_index(body)];
  if (joints.size() > 1) {
    dMass mass = mass_of(its);
    dMassAdjust(&mass, its.mass_kg * (1.0 - intermediate_share * static_cast<double>(joints.size() - 1)));
    dBodySetMass(last, &mass);
  }
  dBodyID parent = bodies_[to_index(its.parent)];
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const Joint& joint = robot.joints[to_index(joints[i])];
    dBodyID child = last;
    if (i + 1 < joints.size()) {
      child = dBodyCreate(world_);
      dMass mass = mass_of(its);
      dMassAdjust(&mass, its.mass_kg * intermediate_share);
      dBodySetMass(child, &mass);
      set_pose(child, its, pose);
      intermediates_.push_back({child, body, i + 1});
    }
    bearings_.push_back(
        {new_hinge(world_, parent, child, pose * joint.anchor_m, rotate(pose.rotation, joint.axis), joint),
         joints[i], -1});
    parent = child;
  }
}

Vec3 mesh_centre(const Geom& geom) {
  Vec3 centre;
  for (const Vec3 vertex : geom.vertices_m)
    centre = centre + (1.0 / static_cast<double>(geom.vertices_m.size())) * vertex;
  return centre;
}

void World::add_geoms(const RobotSpec& robot) {
  ground_ = dCreatePlane(nullptr, 0.0, 0.0, 1.0, 0.0);
  for (const Geom& geom : robot.geoms) {
    if (!geom.collides) {
      geoms_.push_back(nullptr);
      continue;
    }
    Vec3 centre;
    dGeomID id = nullptr;
    if (geom.shape == Shape::mesh) {
      centre = mesh_centre(geom);
      id = new_convex(convexes_.emplace_back(convex_arrays(geom, centre)));
    } else {
      id = new_geom(geom);
    }
    const Vec3 offset =
        geom.position_m + rotate(geom.rotation, centre) - robot.bodies[to_index(geom.body)].com_m;
    const dQuaternion rotation{geom.rotation.w, geom.rotation.x, geom.rotation.y, geom.rotation.z};
    dGeomSetBody(id, bodies_[to_index(geom.body)]);
    dGeomSetOffsetPosition(id, offset.x, offset.y, offset.z);
    dGeomSetOffsetQuaternion(id, rotation);
    geoms_.push_back(id);
  }
}

}  // namespace amble::physics::ode
