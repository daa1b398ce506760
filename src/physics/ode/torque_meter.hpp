#pragma once

#include <ode/ode.h>

#include <optional>
#include <vector>

#include "amble/core/lanes.hpp"
#include "amble/core/math.hpp"
#include "amble/physics/ode/motors.hpp"
#include "amble/robot/spec.hpp"

namespace amble::physics::ode {

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
