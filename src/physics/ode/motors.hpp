#pragma once

#include <ode/ode.h>
#include <optional>
#include <span>
#include <vector>

#include "amble/core/lanes.hpp"
#include "amble/core/math.hpp"
#include "amble/physics/ode/world.hpp"
#include "amble/robot/spec.hpp"

namespace amble::physics::ode {

/// What acts in a robot's joints: servos, armature, damping and dry friction.
///
/// Servos are ODE's joint motors (manual, "Stops and motor parameters"), a constraint
///   q̇⁺ + softness τ = speed with |τ| ≤ max_torque.
/// A velocity servo has speed = gain (target − q) and the world's cfm. A torque servo takes the angle and
/// speed at the end of a step h (backward Euler), so that it is stable however stiff it is:
///   τ = kp (target − q − h q̇⁺) − kd q̇⁺ = (speed − q̇⁺) / softness,   1/softness = kp h + kd,
///   speed = softness kp (target − q).
/// At a stop it is the explicit torque kp (target − q) within ± max_torque. The spring of a joint without a
/// motor is a torque servo without a limit.
///
/// Armature and damping are such constraints without bounds, −(armature/h) (q̇⁺ − q̇) − damping q̇⁺, and dry
/// friction is one with |τ| ≤ friction_loss and speed 0, by motors of their own (dJointTypeAMotor).
class Motors {
 public:
  Motors(const robot::RobotSpec& robot, const World& world, double timestep_s);

  /// Says which turn each joint is in, for those that turn beyond ± π; at first all are at 0.
  void start_at(std::span<const double> angles_rad);
  /// Angles (rad) of the last read(), and speeds (rad/s) now, in control order.
  const std::vector<double>& angles_rad() const { return angles_rad_; }
  std::vector<double> speeds_rad_s() const;
  /// Writes all angles to `angles_rad` (joints × 1).
  void read(LaneArray& angles_rad);
  /// Sets speeds and torques for the next step. Uses the angles of the last read().
  void drive(const LaneArray& targets_rad);

  const std::vector<Bearing>& bearings() const { return bearings_; }
  /// A servo's torque in the next step, N m, where it does not depend on the step's solution, at a stop: the
  /// explicit torque of a torque servo, and for a velocity servo max_torque in the direction of the wanted
  /// speed, which is what ODE applies (dxJointLimitMotor::addLimot). 0 of a joint without a motor.
  std::optional<double> torque_beforehand(int joint, const LaneArray& targets_rad) const;

 private:
  /// The axis of a joint of the robot.
  struct Axis {
    dJointID bearing = nullptr;
    int number = 0;              ///< 0: of a hinge; 1, 2: of a universal joint
    dJointID inertia = nullptr;  ///< motor of armature and damping; null: none
    bool many_turns = false;     ///< its stops are beyond ± π: set anew before each step
  };

  void add_axis(const World& world, const Bearing& bearing, int number);
  dJointID new_motor(const World& world, const Axis& axis, double max_torque_nm, double softness) const;
  void watch_stops(int joint) const;
  double target(int joint, const LaneArray& targets_rad) const;
  bool at_stop(int joint) const;
  double torque_at_stop(int joint, double target_rad) const;
  double rate_rad_s(const Axis& axis) const;
  /// kp h + kd.
  double stiffness(int joint) const;
  void drive_joint(int joint, double target_rad) const;

  const std::vector<robot::Joint>& joints_;
  std::vector<robot::Servo> servos_;  ///< by joint; of those without a motor their springs
  const std::vector<Bearing>& bearings_;
  double timestep_s_;
  std::vector<Axis> axes_;  ///< by joint
  std::vector<double> angles_rad_;
};

/// The motors' torques in a step, from the forces that ODE reports for each joint (manual, "Joint feedback")
/// and the torques that are known beforehand. Measuring changes no bit of the motion.
class TorqueMeter {
 public:
  TorqueMeter(const robot::RobotSpec& robot, const Motors& motors);
  TorqueMeter(const TorqueMeter&) = delete;
  TorqueMeter& operator=(const TorqueMeter&) = delete;

  /// Between Motors::drive() and the step: notes the frames of the joints, which are those of the solver.
  void before_step(const LaneArray& targets_rad);
  /// After the step: torques in N m, joints × 1.
  void after_step(LaneArray& torques_nm) const;

 private:
  /// A joint at the beginning of a step, in the world.
  struct JointFrame {
    Vec3 anchor_m;  ///< from the centre of mass of the joint's first body
    Vec3 axis1, axis2;
  };

  const Motors& motors_;
  std::vector<dJointFeedback> feedback_;         ///< by bearing
  std::vector<JointFrame> frames_;               ///< by bearing
  std::vector<std::optional<double>> known_nm_;  ///< by joint
};

}  // namespace amble::physics::ode
