#pragma once

#include "amble/physics/batch/batch_engine.hpp"
#include "amble/robot/spec.hpp"

namespace amble::physics::batch {

/// Velocities from momenta: the root's frame is at `root`, all else as in `state`.
MovingPose motion_of(const robot::RobotSpec& robot, const RootPose& root, const RobotState& state);

/// The reverse: sets the velocities and the momentum of `state`.
void set_velocities(const robot::RobotSpec& robot, const MovingPose& motion, RobotState& state);

}  // namespace amble::physics::batch
