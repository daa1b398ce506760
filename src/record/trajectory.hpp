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
/// As files write them, by Outcome.
inline constexpr std::array<std::string_view, 3> outcome_names{"completed", "fell", "diverged"};

/// When the path of a trial is sampled: once in every `stride` steps, after the first_step-th of them.
struct PathSampling {
  int stride = 0;      ///< steps from one sample to the next; 0: never
  int first_step = 1;  ///< 1 … stride

  /// Samples of a trial of so many steps: one per whole stride.
  int count(int steps) const { return stride > 0 ? steps / stride : 0; }
  /// Whether there is one after step `step` (from 1) of a trial of `steps` steps.
  bool at(int step, int steps) const {
    return stride > 0 && (step - first_step) % stride == 0 && (step - 1) / stride < count(steps);
  }
};

/// Optional measurements of a trial, which cost time: which members of its Trajectory are filled in.
struct Measures {
  bool energy = false,      ///< Trajectory::energy_j; only in an engine that measures torques
      uprightness = false,  ///< Trajectory::upright_steps
      seconds = false,      ///< Trajectory::com_by_second_m
      contacts = false,     ///< Trajectory::contact_steps
      footfalls = false,    ///< Trajectory::footfall_steps
      height = false,       ///< Trajectory::height_steps_m
      headings = false,     ///< Trajectory::turned_by_second_rad and turned_rad
      commands = false,     ///< Trajectory::command_by_second, and what `headings` has
      effort = false,       ///< Trajectory::effort_steps; only in an engine that measures torques
      root = false;         ///< Trajectory::root_start_m and root_end_m

  /// Measures what the other does, too.
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

/// The result of a trial, sufficient for scoring. In the world's frame (docs/CONVENTIONS.md). What was not
/// measured is 0 or empty.
struct Trajectory {
  Outcome outcome = Outcome::completed;  ///< how it ended
  int steps = 0;                         ///< steps simulated, the last of them included
  double timestep_s = 0.0;               ///< length of a step
  Vec3 com_start_m;                      ///< whole-body centre of mass before the first step
  Vec3 com_end_m;                 ///< and after the last; of a diverged trial, after the last healthy one
  std::vector<float> com_path_m;  ///< x0, y0, x1, y1, … as sampled (PathSampling), relative to com_start_m
  /// Projection on the ground of the root's forward axis before the first step, of unit length: the axis that
  /// points along the world's x in the robot's own start pose.
  /// @{
  double forward_x = 1.0, forward_y = 0.0;
  /// @}
  /// @{
  /// The same axis after the last step; of a diverged trial, as before the first.
  double forward_end_x = 1.0, forward_end_y = 0.0;
  /// @}
  /// Measures::seconds: centre of mass after each whole second, x0, y0, x1, y1, …, relative to com_start_m.
  std::vector<double> com_by_second_m;
  /// Measures::energy: Σ |torque × change of angle| over motors and steps, braking counted like driving.
  double energy_j = 0.0;
  Vec3 root_start_m,  ///< Measures::root: origin of the root's frame before the first step
      root_end_m;     ///< Measures::root: and after the last healthy one
  /// Measures::effort: Σ (torque / largest torque)² over motors and steps.
  double effort_steps = 0.0;
  /// Measures::uprightness: sum over steps of the cosine between the world's z axis (on a slope the ground's
  /// normal) and the axis of the root that points along it in the start pose.
  double upright_steps = 0.0;
  /// Measures::contacts: for each leg, the number of steps after which its touch sensor read 1.
  std::vector<int> contact_steps;
  /// Measures::footfalls: for each leg, the steps after which its foot came down (record/footfall.hpp), from
  /// 1, ascending.
  std::vector<std::vector<int>> footfall_steps;
  /// Measures::height: sum over steps of the height of the root's centre of mass over the ground below it, m.
  double height_steps_m = 0.0;

  /// Measures::headings: how far the root has turned to the left since the start, whole turns counted, after
  /// each whole second.
  std::vector<double> turned_by_second_rad;
  /// Measures::headings: the same after the last healthy step.
  double turned_rad = 0.0;
  /// Measures::commands or headings: mean of what was commanded in each whole second, speed (m/s) and turn
  /// (rad/s) in turn. Empty without commands. Measures::commands: also for the seconds that the trial was cut
  /// off from, by a fall or as it diverged, what would have been commanded at their ends.
  std::vector<double> command_by_second;

  /// How long it lasted, s: also the time of the last step.
  double seconds() const { return steps * timestep_s; }
};

}  // namespace amble::record
