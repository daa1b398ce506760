#pragma once

#include <vector>

#include "amble/core/lanes.hpp"
#include "amble/physics/batch/rows.hpp"
#include "amble/physics/batch/workspace.hpp"
#include "amble/physics/engine.hpp"

namespace amble::physics::batch {

/// What one call works on. Belongs to one thread.
struct Batch {
  const Model& model;
  const Rows& rows;
  Row* state;  ///< rows.count of them
  Workspace& workspace;
  robot::SensorFrame& sensors;
  LaneArray* torques_nm;  ///< of the motors, joints × lanes; null: not asked for
  float timestep_s;
};

/// Advances all active lanes by one timestep and reads the sensors. Denormal numbers count as zero.
void step(const Batch& batch, const LaneArray& targets_rad);

/// Derives from the state proper of all lanes whatever follows from it: poses, sensors, touch.
void derive(const Batch& batch);

/// sin, cos and atan2 as the engine computes them, for tests: values of `count` angles, in place of y the
/// atan2(y, x).
void sine_cosine(const float* angles_rad, float* sines, float* cosines, int count);
void arc_tangent(const float* y, const float* x, float* angles_rad, int count);

}  // namespace amble::physics::batch
