#pragma once

#include <ode/ode.h>

#include <optional>
#include <vector>

#include "amble/core/lanes.hpp"
#include "amble/physics/ode/world.hpp"
#include "amble/robot/spec.hpp"

namespace amble::physics::ode {

/// The servos of a robot's joints. A velocity servo is ODE's joint motor (manual, "Stops and motor
/// parameters"): a constraint q̇⁺ + cfm τ = gain (target − q) with |τ| ≤ max_torque. A torque servo is an
/// explicit torque τ = kp (target − q) − kd q̇, clamped to ± max_torque.
class Motors {
 public:
  /// One ODE joint with the motors it carries.
  struct Drive {
    dJointID joint = nullptr;
    int first = -1;   ///< index of the joint about ODE's first (or only) axis
    int second = -1;  ///< about the second axis, −1: a hinge
  };

  Motors(const robot::RobotSpec& robot, const World& world);

  /// Writes all angles to `angles_rad` (joints × 1).
  void read(LaneArray& angles_rad);
  /// Sets speeds and torques for the next step. Uses the angles of the last read().
  void drive(const LaneArray& targets_rad);

  const std::vector<Drive>& drives() const { return drives_; }
  /// A motor's torque in the next step, N m, where it does not depend on the step's solution: that of a
  /// torque servo, and that of a velocity servo at a stop, where ODE applies max_torque in the direction of
  /// the wanted speed (dxJointLimitMotor::addLimot).
  std::optional<double> torque_beforehand(const Drive& drive, int joint, const LaneArray& targets_rad) const;

 private:
  double target(int joint, const LaneArray& targets_rad) const;
  double rate_rad_s(const Drive& drive, int joint) const;
  double speed_command(int joint, double target_rad) const;
  double torque_command(int joint, double target_rad, double speed_rad_s) const;
  void drive_hinge(const Drive& drive, double target_rad) const;
  void drive_universal(const Drive& drive, double target1_rad, double target2_rad) const;

  const std::vector<robot::Joint>& joints_;
  std::vector<Drive> drives_;
  std::vector<double> angles_rad_;
};

}  // namespace amble::physics::ode
