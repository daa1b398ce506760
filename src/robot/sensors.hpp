#pragma once

#include "amble/core/lanes.hpp"
#include "amble/core/math.hpp"

namespace amble::robot {

/// The inputs of controllers, for all lanes at once. Rows in control order (RobotSpec::joints) and leg order.
struct SensorFrame {
  LaneArray joint_angle_rad;  ///< joints × lanes
  LaneArray touch;            ///< legs × lanes: 1 while the foot touches the ground, else 0
  LaneArray attitude_rad;     ///< 3 × lanes: roll, pitch, yaw of the root (core/math.hpp) in the level frame
};

/// The level frame in the world, in which attitude is measured: its z axis points against gravity. Where that
/// is the world's z axis, or there is no gravity, it is the world's frame; else the one that is turned least.
Quat level_frame(Vec3 gravity_m_s2);

}  // namespace amble::robot
