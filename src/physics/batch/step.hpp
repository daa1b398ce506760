#pragma once

#include <vector>

#include "amble/core/lanes.hpp"
#include "amble/physics/batch/state_rows.hpp"
#include "amble/physics/batch/workspace.hpp"
#include "amble/physics/engine.hpp"

namespace amble::physics::batch {

/// Uneven ground as the kernels read it (ground::Ground).
struct UnevenGround {
  std::vector<const float*> fields;  ///< by Point::field; 256 × 256 heights (m), x faster than y
  float cells_per_m = 0.0f;
  float highest_m = 0.0f;
};

/// What one call of step() or derive() works on. Belongs to one thread.
struct StepArguments {
  const Model& model;
  const StateRows& rows;
  Row* state;  ///< rows.count rows
  Workspace& workspace;
  robot::SensorFrame& sensors;
  const UnevenGround* ground;  ///< null: the plane z = 0
  LaneArray* torques_nm;       ///< of the motors, joints × lanes; null: not measured
  float timestep_s;
};

/// Advances all active lanes by one timestep and reads the sensors. Denormal numbers count as zero.
void step(const StepArguments& arguments, const LaneArray& targets_rad);

/// Computes what follows from the state of all lanes: poses, touch, sensors.
void derive(const StepArguments& arguments);

/// sin, cos and atan2 as the engine computes them, for tests. `count` must be a multiple of the vector's
/// width.
void sine_cosine(const float* angles_rad, float* sines, float* cosines, int count);
void arc_tangent(const float* y, const float* x, float* angles_rad, int count);

}  // namespace amble::physics::batch
