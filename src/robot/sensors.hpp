#pragma once

#include "amble/core/lanes.hpp"
#include "amble/core/math.hpp"

namespace amble::robot {

/// The inputs of controllers, for all lanes at once, float32. Rows in control order (RobotSpec::joints) and
/// leg order (RobotSpec::legs).
struct SensorFrame {
  LaneArray joint_angle_rad;  ///< joints × lanes, from the robot's own start pose
  LaneArray touch;            ///< legs × lanes: 1 while the foot touches the ground, else 0
  /// 3 × lanes: roll, pitch, yaw (core/math.hpp) of RobotSpec::turned() in the level frame.
  LaneArray attitude_rad;

  // What engines leave empty, and trials fill in where it is asked for (trial/senses.hpp).
  LaneArray joint_speed_rad_s =
      {};  ///< joints × lanes: angle turned in the last tick / its length, 0 in the first
  LaneArray joint_torque_nm = {};  ///< joints × lanes: the motors' in the last step
  LaneArray yaw_rate_rad_s = {};   ///< 1 × lanes: likewise, of the yaw
  LaneArray foot_load_n = {};      ///< legs × lanes: the ground's normal force in the last step
  /// 2 × lanes: what the robot is told, speed along its own forward axis (m/s) and turn to the left (rad/s).
  LaneArray command = {};
  /// 1 × lanes: 1 where both are 0, else 0.
  LaneArray command_stop = {};
  /// 1 × lanes, −π … π: how far the heading that the commanded turns lead to is to the left of the robot's.
  LaneArray heading_error_rad = {};
};

/// Which of a frame's rows that not every controller needs are asked for.
struct ExtraSenses {
  bool speed = false,         ///< SensorFrame::joint_speed_rad_s
      torque = false,         ///< SensorFrame::joint_torque_nm; only of an engine that measures torques
      yaw_rate = false,       ///< SensorFrame::yaw_rate_rad_s
      load = false;           ///< SensorFrame::foot_load_n; only of an engine that measures loads
  bool command = false,       ///< SensorFrame::command and command_stop
      heading_error = false;  ///< SensorFrame::heading_error_rad

  /// Whether engines' frames are not enough.
  bool any() const { return speed || torque || yaw_rate || load || commands(); }
  /// Whether anything depends on what the robot is told.
  bool commands() const { return command || heading_error; }
  /// Asks for what the other does, too.
  ExtraSenses& operator|=(const ExtraSenses& other) {
    speed |= other.speed;
    torque |= other.torque;
    yaw_rate |= other.yaw_rate;
    load |= other.load;
    command |= other.command;
    heading_error |= other.heading_error;
    return *this;
  }
  friend bool operator==(const ExtraSenses&, const ExtraSenses&) = default;
};

/// The level frame in the world, in which attitude is measured: its z axis points against gravity. Where that
/// is the world's z axis, or there is no gravity, it is the world's frame; else the one that is turned least.
Quat horizontal_frame(Vec3 gravity_m_s2);

}  // namespace amble::robot
