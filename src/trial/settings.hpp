#pragma once

#include <array>
#include <string_view>

#include "amble/io/settings.hpp"

namespace amble::trial {

/// When a controller first acts.
enum class FirstCommand {
  before_first_step,  ///< tick 1 reads the start pose and commands step 1
  /// Tick 1 reads the sensors after step 1 and commands step 2 (the authors' code). In step 1 the motors hold
  /// each joint where it is, with all their torque; with latency they hold the joints at 0 until that
  /// arrives.
  after_first_step
};
/// As configs write them, by FirstCommand.
inline constexpr std::array<std::string_view, 2> first_command_names{"before_first_step", "after_first_step"};

/// One trial: a robot walks for a while, or until it falls. Ranges are those that describe() holds a config
/// to.
struct Settings {
  double duration_s = 15.0;  ///< length of a trial that completes, 0.001 … 1e6 (Morse et al. 2013, sec. 4)
  double timestep_s = 0.01;  ///< one simulation step and one controller update, 1e−5 … 0.1 (the same)
  FirstCommand first_command = FirstCommand::before_first_step;  ///< when the controller first acts
  double fall_factor = 1.0;  ///< share of the score that counts in evolution if the robot falls, 0 … 1

  void describe(io::SettingsVisitor& visitor);  ///< the table [trial]
  /// Throws SettingError if the duration is not a whole number of timesteps, at least one and at most 1e9.
  void validate() const;
  /// Steps of a trial that completes.
  int steps() const;
};

}  // namespace amble::trial
