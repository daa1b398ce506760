#pragma once

#include <ode/ode.h>

#include <vector>

#include "amble/core/math.hpp"
#include "amble/physics/ode/library.hpp"
#include "amble/robot/pose.hpp"
#include "amble/robot/spec.hpp"

namespace amble::physics::ode {

/// One robot in its start pose in an ODE world of its own. The origin of an ODE body is the centre
/// of mass of a Body, its axes are those of the Body's frame. Built anew for every trial, so that no state of
/// an earlier trial remains.
class World {
 public:
  World(const robot::RobotSpec& robot, const Threading& threading);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Moves the robot, at rest, to `poses` of its bodies' frames in the world.
  void move_to(const robot::RobotSpec& robot, const std::vector<robot::Pose>& poses);

  dWorldID id() const { return world_; }
  /// In the order of RobotSpec::bodies.
  const std::vector<dBodyID>& bodies() const { return bodies_; }
  /// By body: the hinge or universal joint to its parent; null for the root.
  const std::vector<dJointID>& joints() const { return joints_; }
  /// In the order of RobotSpec::geoms; null for those that do not collide.
  const std::vector<dGeomID>& geoms() const { return geoms_; }
  dGeomID ground() const { return ground_; }

 private:
  void add_bodies(const robot::RobotSpec& robot);
  void add_joints(const robot::RobotSpec& robot);
  void add_geoms(const robot::RobotSpec& robot);

  dWorldID world_;
  dGeomID ground_ = nullptr;
  std::vector<dBodyID> bodies_;
  std::vector<dJointID> joints_;
  std::vector<dGeomID> geoms_;
};

/// Throws UserError for what ODE has no joint for; see make_ode_engine().
void check_joints(const robot::RobotSpec& robot);

}  // namespace amble::physics::ode
