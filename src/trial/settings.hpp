#pragma once

#include <array>
#include <string_view>

#include "amble/io/settings.hpp"

namespace amble::trial {

/// When a controller first acts. After the first step: its tick 1 reads the sensors after step 1 and commands
/// step 2. In step 1 the motors hold each joint where it is, with all their torque.
enum class FirstCommand { before_first_step, after_first_step };
inline constexpr std::array<std::string_view, 2> first_command_names{"before_first_step", "after_first_step"};

/// One trial: a robot walks for a while, or until it falls.
struct Settings {
  double duration_s = 15.0;
  double timestep_s = 0.01;
  FirstCommand first_command = FirstCommand::before_first_step;
  double fall_factor = 1.0;

  void describe(io::SettingsVisitor& visitor);
  /// Throws UserError if the duration is not a whole number of timesteps, at least one and at most 1e9.
  void validate() const;
  /// Steps of a trial that completes.
  int steps() const;
};

}  // namespace amble::trial
