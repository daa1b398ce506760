#pragma once

#include <ode/ode.h>
#include <deque>
#include <span>
#include <stdexcept>
#include <vector>

#include "amble/core/math.hpp"
#include "amble/robot/pose.hpp"
#include "amble/robot/spec.hpp"
#include "amble/robot/velocity.hpp"

namespace amble::physics::ode {

/// An internal error of ODE, such as a NaN, on which ODE itself would end the process.
class Fault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Makes ODE ready for the calling thread: initialises the library once per process, with handlers that are
/// silent and throw Fault instead of aborting, and the thread's data once per thread.
void prepare_thread();

/// Where ODE has the centre of a mesh: the mean of its corners, in the geom's axes.
Vec3 mesh_centre(const robot::Geom& geom);

/// Runs the steps of one world in the calling thread. ODE's default shares one implementation among all
/// worlds of the process, which fails an assertion as soon as two threads step.
class Threading {
 public:
  Threading();
  ~Threading();
  Threading(const Threading&) = delete;
  Threading& operator=(const Threading&) = delete;

  void attach_to(dWorldID world) const;
  /// After a Fault out of a step. The unfinished jobs cannot be freed (ODE would abort), so this
  /// implementation is kept until the process ends, and a new one takes its place. ODE also loses the step's
  /// working memory, some 90 KB per Fault.
  void replace();

 private:
  dThreadingImplementationID implementation_;
};

/// A convex hull as ODE wants it: planes (unit normal, distance), points, and polygons (number of corners,
/// corners). ODE keeps pointers to these.
struct ConvexArrays {
  std::vector<dReal> planes, points;
  std::vector<unsigned> polygons;
};

/// An ODE joint and the robot's joints that it is.
struct Bearing {
  dJointID id = nullptr;
  int first = -1;   ///< index in RobotSpec::joints of the one about ODE's first (or only) axis
  int second = -1;  ///< about the second axis; −1: a hinge
};

/// One robot in its start pose in an ODE world of its own. Two joints of a body that cross at a right angle
/// are a universal joint. Otherwise a body with several joints is a chain of hinges with bodies between them
/// that take a thousandth of its mass and inertia each: ODE has no massless bodies. The origin of an ODE body
/// is the centre of mass of a Body, its axes are those of the Body's frame. Built anew for every trial, so
/// that no state of an earlier trial remains.
class World {
 public:
  World(const robot::RobotSpec& robot, const Threading& threading);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Moves the robot, at rest: its root's frame to `root`, its joints to these angles (rad).
  void move_to(const robot::RobotSpec& robot, const robot::Pose& root, std::span<const double> angles_rad);

  /// Lets the robot move; its bodies must be where move_to() has put them for these root and angles.
  void set_velocities(const robot::RobotSpec& robot, const robot::Pose& root, const robot::Twist& root_twist,
                      const robot::JointStates& joints);

  dWorldID id() const { return world_; }
  /// In the order of RobotSpec::bodies.
  const std::vector<dBodyID>& bodies() const { return bodies_; }
  const std::vector<Bearing>& bearings() const { return bearings_; }
  /// In the order of RobotSpec::geoms; null for those that do not collide.
  const std::vector<dGeomID>& geoms() const { return geoms_; }
  dGeomID ground() const { return ground_; }

 private:
  void add_bodies(const robot::RobotSpec& robot);
  void add_joints(const robot::RobotSpec& robot);
  void add_hinges(const robot::RobotSpec& robot, int body, const std::vector<int>& joints,
                  const robot::Pose& pose);
  void add_geoms(const robot::RobotSpec& robot);

  dWorldID world_;
  dGeomID ground_ = nullptr;
  std::vector<dBodyID> bodies_;
  /// A body between two hinges of `body`, of which it follows the first `hinges`.
  struct Intermediate {
    dBodyID id;
    int body;
    std::size_t hinges;
  };
  std::vector<Intermediate> intermediates_;
  std::vector<Bearing> bearings_;
  std::vector<dGeomID> geoms_;
  std::deque<ConvexArrays> convexes_;
};

}  // namespace amble::physics::ode
