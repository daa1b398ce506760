#pragma once

#include <string>
#include <vector>

#include "amble/core/lanes.hpp"
#include "amble/physics/mujoco_model/model.hpp"

namespace amble::physics::mujoco_model {

/// How target angles reach a joint of a model. The first actuator of the joint that can follow an angle has
/// it; others of the joint have control 0.
enum class Way {
  position,  ///< an actuator at whose control the joint rests: the angle (with gear and bias) is its control
  speed,     ///< a velocity actuator: its control is the servo's speed
  motor,     ///< any other: its control is the servo's torque over gear and gain
  applied,   ///< the joint has no actuator: the servo's torque acts on it directly
  free,      ///< the robot has no motor there: actuators that the model has in place of one have control 0
};

/// Drives the joints of a robot in its own model.
///
/// Where the model has no servo of its own, amble's acts, anew at each of MuJoCo's steps, within ±
/// max_torque_nm. With q the angle, A MuJoCo's estimate of a joint's inverse inertia (dof_invweight0) and h
/// the step:
///   ServoMode::torque    kp (target − q) − kd q̇, with kd at most 1/(2 h A) and kp at most 1/(4 h² A), as
///   more
///                        would oscillate
///   with Servo::hold_torque kp and kd as they are, once for all steps of a tick
///   ServoMode::velocity  P + Σ P / 5 over all steps so far, with P = (gain (target − q) − q̇) / (2 h A): the
///                        joint comes to its speed in some steps, whatever the load
class Actuation {
 public:
  /// Throws UserError for an actuator that no angle can be given to (muscles, integrators).
  Actuation(const robot::RobotSpec& robot, const Model& model);

  /// Forgets all steps.
  void reset();
  /// Sets controls and applied torques of the next step, with those that servos hold only in the `first` of a
  /// tick. `targets_rad`: joints × 1, clamped to the stops but for such servos.
  void drive(const LaneArray& targets_rad, bool first, mjData& data);
  /// The sums of velocity servos, N m by joint: with MuJoCo's data the whole state.
  const std::vector<double>& sums_nm() const { return sums_nm_; }
  /// Torque of a joint's drive in the last step, N m, with all of its actuators.
  double torque_nm(std::size_t joint, const mjData& data) const;
  /// What a reader should know of how the joints are driven.
  std::vector<std::string> notes() const;

 private:
  struct Drive {
    Way way = Way::applied;
    int actuator = -1, others = 0;
    int position = 0, dof = 0;
    double start_rad = 0.0, gear = 1.0, gain = 1.0, bias = 0.0, slope = 0.0;
    double kp = 0.0, kd = 0.0;      ///< of amble's torque servo, as it acts
    double speed_per_rad = 0.0;     ///< of a velocity servo or actuator
    double torque_per_speed = 0.0;  ///< of a velocity servo: 1/(2 h A)
    bool weaker = false;            ///< than it would be with a shorter step
  };

  void find_actuator(const robot::Joint& joint, int model_joint, Drive& drive) const;
  void set_servo(const robot::Servo& servo, Drive& drive) const;
  double servo_torque_nm(std::size_t joint, double error_rad, double speed_rad_s);
  [[noreturn]] void refuse(int actuator, const std::string& why) const;

  const robot::RobotSpec& robot_;
  const Model& model_;
  std::vector<Drive> drives_;
  std::vector<double> sums_nm_;
};

}  // namespace amble::physics::mujoco_model
