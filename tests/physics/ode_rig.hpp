#pragma once

#include <ode/ode.h>

#include "amble/physics/ode/contacts.hpp"
#include "amble/physics/ode/motors.hpp"
#include "amble/physics/ode/world.hpp"
#include "tests/physics/full_state.hpp"

namespace amble::physics {

/// A robot in ODE that can be put into any state and stepped by either of ODE's solvers.
class OdeRig {
 public:
  explicit OdeRig(const robot::RobotSpec& robot, double timestep_s = 0.01)
      : robot_((ode::prepare_thread(), robot)),
        world_(robot_, threading_),
        motors_(robot_, world_, timestep_s),
        contacts_(robot_, world_, nullptr),
        angles_(static_cast<int>(robot.joints.size()), 1),
        touch_(static_cast<int>(robot.legs.size()), 1) {}

  void set(const std::vector<BodyMotion>& motions) {
    for (std::size_t b = 0; b < motions.size(); ++b) {
      const BodyMotion& m = motions[b];
      const dBodyID body = world_.bodies()[b];
      const dQuaternion rotation{m.rotation.w, m.rotation.x, m.rotation.y, m.rotation.z};
      dBodySetPosition(body, m.com_m.x, m.com_m.y, m.com_m.z);
      dBodySetQuaternion(body, rotation);
      dBodySetLinearVel(body, m.velocity_m_s.x, m.velocity_m_s.y, m.velocity_m_s.z);
      dBodySetAngularVel(body, m.angular_velocity_rad_s.x, m.angular_velocity_rad_s.y,
                         m.angular_velocity_rad_s.z);
    }
  }

  /// iterations 0: dWorldStep, else dWorldQuickStep.
  void step(const LaneArray& targets_rad, double h, int iterations) {
    motors_.read(angles_);
    contacts_.collide(touch_);
    motors_.drive(targets_rad);
    if (iterations == 0) {
      dWorldStep(world_.id(), h);
    } else {
      dWorldSetQuickStepNumIterations(world_.id(), iterations);
      dWorldQuickStep(world_.id(), h);
    }
  }

  /// Contacts of the step before.
  int contacts() const {
    int count = 0;
    for (const dBodyID body : world_.bodies())
      for (int j = 0; j < dBodyGetNumJoints(body); ++j)
        count += dJointGetType(dBodyGetJoint(body, j)) == dJointTypeContact ? 1 : 0;
    return count;
  }
  /// The root's velocity is left out.
  FullState pose() {
    const dReal* q = dBodyGetQuaternion(world_.bodies()[0]);
    const Quat rotation{q[0], q[1], q[2], q[3]};
    const Vec3 com = vec3(dBodyGetPosition(world_.bodies()[0]));
    FullState state{{com - rotate(rotation, robot_.bodies[0].com_m), rotation}, {}, {}, {}, {}};
    motors_.read(angles_);
    for (int j = 0; j < angles_.rows(); ++j) state.angle_rad.push_back(static_cast<double>(angles_.at(j, 0)));
    return state;
  }
  std::vector<BodyMotion> motions() const {
    std::vector<BodyMotion> motions;
    for (const dBodyID body : world_.bodies()) {
      const dReal* q = dBodyGetQuaternion(body);
      motions.push_back({vec3(dBodyGetPosition(body)),
                         {q[0], q[1], q[2], q[3]},
                         vec3(dBodyGetLinearVel(body)),
                         vec3(dBodyGetAngularVel(body))});
    }
    return motions;
  }
  double angle(int joint) {
    motors_.read(angles_);
    return static_cast<double>(angles_.at(joint, 0));
  }

 private:
  static Vec3 vec3(const dReal* v) { return {v[0], v[1], v[2]}; }

  const robot::RobotSpec robot_;
  ode::Threading threading_;
  ode::World world_;
  ode::Motors motors_;
  ode::Contacts contacts_;
  LaneArray angles_, touch_;
};

}  // namespace amble::physics
