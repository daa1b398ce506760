#pragma once

#include <span>
#include <vector>

#include "amble/robot/spec.hpp"

namespace amble::physics {

/// Mean difference between the velocity of the centre of mass after a step of the batch engine and after the
/// same step with robot::most_sweeps sweeps, m/s, for each number of `sweeps`: of sixteen robots that follow
/// sine waves from their start pose for a second, while they touch the ground. If dry friction of at least
/// half of a motor's torque holds a joint of a leg, the difference between its speeds, times the way to the
/// foot, where that is more. The paper's quadruped has 0.001 with its own number. Where it is much more,
/// gaits exploit the solver's residual error. Throws UserError as make_batch_engine() does.
std::vector<double> solver_errors_m_s(const robot::RobotSpec& robot, double timestep_s,
                                      std::span<const int> sweeps);

/// What a robot needs. Robots with an error of up to 0.012 m/s walk in ODE and MuJoCo as they do in the batch
/// engine, one with 0.02 did not (docs/ROBOTS.md): from 0.015 m/s on, the first number of sweeps of a
/// geometric series whose error is at most 0.005, as that of the gallery's robots is.
struct SweepsAdvice {
  int sweeps = 0;          ///< that the robot has
  double error_m_s = 0.0;  ///< with those
  int better_sweeps = 0;   ///< equal to `sweeps` if they are enough
  double better_error_m_s = 0.0;
};
SweepsAdvice sweeps_advice(const robot::RobotSpec& robot, double timestep_s);

}  // namespace amble::physics
