#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "amble/core/math.hpp"

namespace amble::record {

/// How a trial ended. A diverged simulation is an outcome, not an error.
enum class Outcome : std::uint8_t {
  completed = 0,  ///< ran its full time
  fell = 1,       ///< RobotSpec::fall_rule was met
  diverged = 2,   ///< values not finite, or absurdly large; the last healthy state counts
};
inline constexpr std::array<std::string_view, 3> outcome_names{"completed", "fell", "diverged"};

/// When the path of a trial is sampled: once in every `stride` steps, after the first_step-th of them.
struct PathSampling {
  int stride = 0;      ///< 0: never
  int first_step = 1;  ///< 1 … stride

  /// Samples of a trial of so many steps: one per whole stride.
  int count(int steps) const { return stride > 0 ? steps / stride : 0; }
  /// Whether there is one after step `step` (from 1) of a trial of `steps` steps.
  bool at(int step, int steps) const {
    return stride > 0 && (step - first_step) % stride == 0 && (step - 1) / stride < count(steps);
  }
};

/// Optional measurements of a trial, which cost time.
struct Measures {
  bool energy = false, uprightness = false, seconds = false, contacts = false, footfalls = false,
       height = false, headings = false, commands = false, effort = false, root = false;

  Measures& operator|=(const Measures& other) {
    energy |= other.energy;
    uprightness |= other.uprightness;
    seconds |= other.seconds;
    contacts |= other.contacts;
    footfalls |= other.footfalls;
    height |= other.height;
    headings |= other.headings;
    commands |= other.commands;
    effort |= other.effort;
    root |= other.root;
    return *this;
  }
  /// Whether the engine must measure torques for them.
  bool need_torques() const { return energy || effort; }
};

/// Whole seconds in a time, s; a time a rounding error short of one more has that, too.
inline int second_count(double time_s) {
  return static_cast<int>(std::floor(time_s + 1e-9));
}

/// The result of a trial, sufficient for scoring. In the world's frame (docs/CONVENTIONS.md).
struct Trajectory {
  Outcome outcome = Outcome::completed;
  int steps = 0;  ///< steps simulated, the last of them included
  double timestep_s = 0.0;
  Vec3 com_start_m;               ///< whole-body centre of mass before the first step
  Vec3 com_end_m;                 ///< and after the last
  std::vector<float> com_path_m;  ///< x0, y0, x1, y1, … as sampled (PathSampling), relative to com_start_m
  /// Projection on the ground of the root's forward axis before the first step, of unit length: the axis that
  /// points along the world's x in the robot's own start pose.
  double forward_x = 1.0, forward_y = 0.0;
  /// The same axis after the last step.
  double forward_end_x = 1.0, forward_end_y = 0.0;
  /// Measures::seconds: centre of mass after each whole second, x0, y0, x1, y1, …, relative to com_start_m.
  std::vector<double> com_by_second_m;
  /// Measures::energy: Σ |torque × change of angle| over motors and steps, J.
  double energy_j = 0.0;
  /// Measures::root: the origin of the root's frame before the first step and after the last.
  Vec3 root_start_m, root_end_m;
  /// Measures::effort: Σ (torque / largest torque)² over motors and steps.
  double effort_steps = 0.0;
  /// Measures::uprightness: sum over steps of the cosine between the root's z axis and the vertical.
  double upright_steps = 0.0;
  /// Measures::contacts: of each leg, the steps after which its foot touched something.
  std::vector<int> contact_steps;
  /// Measures::footfalls: of each leg, the steps after which its foot came down (footfall.hpp), ascending
  /// from 1.
  std::vector<std::vector<int>> footfall_steps;
  /// Measures::height: sum over steps of the height of the root's centre of mass over the ground below it, m.
  double height_steps_m = 0.0;

  /// Measures::headings: how far the root has turned to the left since the start, whole turns counted, after
  /// each whole second and after the last step, rad.
  std::vector<double> turned_by_second_rad;
  double turned_rad = 0.0;
  /// Measures::commands: mean of what was commanded in each whole second, speed (m/s) and turn (rad/s) in
  /// turn. Empty without commands.
  std::vector<double> command_by_second;

  double seconds() const { return steps * timestep_s; }
};

}  // namespace amble::record
