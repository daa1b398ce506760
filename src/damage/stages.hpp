#pragma once

#include <cstddef>
#include <vector>

#include "amble/core/math.hpp"
#include "amble/damage/settings.hpp"
#include "amble/robot/spec.hpp"

namespace amble::damage {

/// Adds a point mass at `at_m`, in the body's frame: the body's mass, centre of mass and inertia become those
/// of both.
void add_point_mass(robot::Body& body, double mass_kg, Vec3 at_m);

/// A joint that is held.
struct Lock {
  std::size_t joint = 0;  ///< index among those of the intact robot
  double angle_rad = 0.0;
};

/// The robot as it is from a moment of the trial on.
struct Stage {
  double from_s = 0.0;
  robot::RobotSpec robot;     ///< as an engine simulates it: without missing legs
  std::vector<int> joint_of;  ///< by joint of `robot`: its index in the intact robot
  std::vector<int> leg_of;    ///< by leg of `robot`: likewise
  std::vector<Lock> locks;    ///< of joints that are there
};

/// Stages by rising `from_s`, the first from 0 on. `settings` must be valid for this robot.
///
/// A locked joint has a velocity servo of `lock_torque_nm` and 9/s, which is as good as rigid, and moves it
/// to its angle when the damage begins during a trial. A missing leg is removed with all that hangs on it.
std::vector<Stage> stages_of(const robot::RobotSpec& robot, const Settings& settings);
inline constexpr double lock_torque_nm = 1e5, lock_gain_per_s = 9.0;

/// The robot as it is when a trial begins.
robot::RobotSpec robot_at_start(const robot::RobotSpec& robot, const Settings& settings);

/// The intact robot with pale geoms where a leg is missing when the trial begins.
robot::RobotSpec as_drawn(const robot::RobotSpec& robot, const Settings& settings);

/// A foot whose touch sensor reads 0.
struct NumbFoot {
  int leg = 0;
  double from_s = 0.0;
};
std::vector<NumbFoot> numb_feet(const robot::RobotSpec& robot, const Settings& settings);

/// The first step, from 1, that begins at `from_s` or later.
int first_step(double from_s, double timestep_s);

}  // namespace amble::damage
