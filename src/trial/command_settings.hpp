#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "amble/io/settings.hpp"
#include "amble/trial/settings.hpp"

namespace amble::trial {

/// Where the commands of a trial come from: there are none, they are listed, or drawn by chance.
enum class CommandKind { none, fixed, random };
inline constexpr std::array<std::string_view, 3> command_kind_names{"none", "fixed", "random"};

/// A stretch of time in which the command stays as it is.
struct CommandStretch {
  double speed_m_s = 0.0;   ///< along the robot's own forward axis
  double turn_rad_s = 0.0;  ///< to the left
  double seconds = 0.0;     ///< 0: with the others of 0, an equal share of the rest of the trial

  void describe(io::SettingsVisitor& visitor);
  friend bool operator==(const CommandStretch&, const CommandStretch&) = default;
};

/// What robots are told to do in trials: by default nothing. A CommandSchedule comes of it (commands.hpp).
struct CommandSettings {
  CommandKind kind = CommandKind::none;
  std::vector<CommandStretch> stretches = {};
  double ramp_s = 0.0;
  // Of CommandKind::random:
  double stretch_s = 5.0;
  double least_speed_m_s = 0.0, most_speed_m_s = 0.4;
  double most_turn_rad_s = 0.5;
  double straight_share = 0.2, stop_share = 0.1;
  bool mirrored = true;

  void describe(io::SettingsVisitor& visitor);
  /// Throws SettingError: nothing listed, or lists and shares that leave no time or make no sense.
  void validate(const Settings& trial) const;
  bool is_default() const { return *this == CommandSettings(); }
  /// Whether trials differ by their commands.
  bool varies() const { return kind == CommandKind::random; }
  friend bool operator==(const CommandSettings&, const CommandSettings&) = default;
};

}  // namespace amble::trial
