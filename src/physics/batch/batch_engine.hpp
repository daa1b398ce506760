#pragma once

#include <memory>
#include <vector>

#include "amble/physics/engine.hpp"

namespace amble::physics {

/// State of one robot in full.
struct BatchState {
  Vec3 com_m;                                  ///< of the whole robot, world
  Quat rotation;                               ///< of the root
  Vec3 velocity_m_s;                           ///< of the centre of mass, world
  Vec3 spin_kg_m2_s;                           ///< angular momentum about the centre of mass, world
  std::vector<double> angle_rad, speed_rad_s;  ///< of the joints, in control order
};

/// An engine whose robots can be put into any state.
class BatchEngine : public Engine {
 public:
  /// The lane must be placed. Impulses of the step before, where the solver starts, are forgotten.
  virtual void set_state(int lane, const BatchState& state) = 0;
  virtual BatchState state(int lane) const = 0;
  /// Points that touched the ground at the beginning of the step before.
  virtual int contacts(int lane) const = 0;
};

/// Sixteen robots in lockstep, one per SIMD lane, float32: docs/BATCH.md. Knows serial chains of hinges on
/// the root, spheres, capsules and boxes against the ground, and no self-collision; throws UserError for
/// other robots.
std::unique_ptr<BatchEngine> make_batch_engine(const robot::RobotSpec& robot, const EngineSettings& settings);

}  // namespace amble::physics
