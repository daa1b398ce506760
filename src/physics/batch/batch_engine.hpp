#pragma once

#include <memory>
#include <vector>

#include "amble/physics/engine.hpp"
#include "amble/robot/spec.hpp"

namespace amble::physics {

/// The whole state of one robot in the coordinates that the engine integrates (docs/BATCH.md).
struct RobotState {
  Vec3 com_m;                                  ///< of the whole robot, world
  Quat rotation;                               ///< of the root
  Vec3 velocity_m_s;                           ///< of the centre of mass, world
  Vec3 angular_momentum_kg_m2_s;               ///< about the centre of mass, world
  std::vector<double> angle_rad, speed_rad_s;  ///< of the joints, in control order
};

/// An engine whose robots can be set to any state.
class BatchEngine : public Engine {
 public:
  /// The lane must be placed. Drops the last step's impulses, from which the solver would start.
  virtual void set_state(int lane, const RobotState& state) = 0;
  virtual RobotState state(int lane) const = 0;
  /// Number of points that touched the ground at the beginning of the last step.
  virtual int contacts(int lane) const = 0;
};

/// Sixteen robots in lockstep, one per SIMD lane, float32: docs/BATCH.md. Simulates chains of hinges on the
/// root, which may branch, with spheres, capsules, boxes, cylinders and the hulls of meshes against the plane
/// or uneven ground, without self-collision. Throws UserError for other robots.
std::unique_ptr<BatchEngine> make_batch_engine(const robot::RobotSpec& robot, const EngineSettings& settings);

}  // namespace amble::physics

namespace amble::physics::batch {

/// Velocities from momenta: the root's frame is at `root`, all else as in `state`.
MovingPose motion_of(const robot::RobotSpec& robot, const RootPose& root, const RobotState& state);

/// The reverse: sets the velocities and the momentum of `state`.
void set_velocities(const robot::RobotSpec& robot, const MovingPose& motion, RobotState& state);

}  // namespace amble::physics::batch
