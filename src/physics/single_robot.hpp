#pragma once

#include "amble/core/math.hpp"
#include "amble/physics/engine.hpp"

namespace amble::physics {

/// Common part of engines with one lane: the lane's flags, the sensors and the torques.
///
/// A derived class fills `sensors_` where it places the robot and in each step(): joint_angle_rad (joints ×
/// 1) and touch (legs × 1), attitude_rad by sense_attitude(). step() returns if can_step() is false; else it
/// sets `healthy_`, `torques_nm_` (joints × 1) if `with_torques_`, and `loads_n_` (legs × 1) if
/// `with_loads_`. It copies the robot.
class SingleRobotEngine : public Engine {
 public:
  int lanes() const final { return 1; }  ///< one
  void retire(int lane) final;
  bool healthy(int lane) const final;
  const robot::SensorFrame& sensors() const final { return sensors_; }
  const LaneArray* motor_torque_nm() const final { return with_torques_ ? &torques_nm_ : nullptr; }
  const LaneArray* foot_load_n() const final { return with_loads_ ? &loads_n_ : nullptr; }

 protected:
  /// Makes sensors, torques and loads of this robot's size.
  SingleRobotEngine(const robot::RobotSpec& robot, const EngineSettings& settings);

  /// AMBLE_CHECK: the lane is 0.
  static void check_lane(int lane);
  /// To be called by place(), place_at() and place_moving(): the lane is placed and healthy, its torques and
  /// loads are 0.
  void place_here();
  /// Whether the lane is placed and healthy. NaN among the targets ends the trial as diverged (in ODE it
  /// would cause a Fault, which costs memory). AMBLE_CHECK: there is a target for each joint.
  bool can_step(const LaneArray& targets_rad);
  /// AMBLE_CHECK: the lane is 0 and placed.
  void check_pushable(int lane) const;
  /// Sets the attitude in `sensors_` from the root's rotation (root axes → world axes).
  void sense_attitude(const Quat& rotation);

  const robot::RobotSpec robot_;  ///< what is simulated
  const bool with_torques_,       ///< EngineSettings::torques
      with_loads_;                ///< EngineSettings::loads
  robot::SensorFrame sensors_;    ///< what sensors() gives
  LaneArray torques_nm_,          ///< joints × 1, empty without `with_torques_`
      loads_n_;                   ///< legs × 1, empty without `with_loads_`
  const Quat level_;              ///< from the level frame to the world: robot::horizontal_frame
  const bool tilted_;             ///< whether the two differ, as on a slope
  const bool turned_;             ///< whether the root's axes differ from the world's in the start pose
  bool stepping_ = false;         ///< whether the lane is placed
  bool healthy_ = true;           ///< what healthy() gives
};

}  // namespace amble::physics
