#pragma once

#include "amble/core/lanes.hpp"

namespace amble::robot {

/// The inputs of controllers, for all lanes at once. Rows in control order (RobotSpec::joints) and leg order.
struct SensorFrame {
  LaneArray joint_angle_rad;  ///< joints × lanes
  LaneArray touch;            ///< legs × lanes: 1 while the foot touches the ground, else 0
  LaneArray attitude_rad;     ///< 3 × lanes: roll, pitch, yaw of the root (core/math.hpp)
};

}  // namespace amble::robot
