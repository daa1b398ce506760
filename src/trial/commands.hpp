#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "amble/core/random.hpp"
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

/// What robots are told to do in trials: by default nothing. A CommandSchedule comes of it.
struct CommandSettings {
  CommandKind kind = CommandKind::none;
  std::vector<CommandStretch> stretches = {};
  double ramp_s = 0.0;
  // For CommandKind::random:
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

/// What a robot is told.
struct Command {
  float speed_m_s = 0.0f;   ///< along its own forward axis
  float turn_rad_s = 0.0f;  ///< to the left

  bool is_stop() const { return speed_m_s == 0.0f && turn_rad_s == 0.0f; }
  friend bool operator==(const Command&, const Command&) = default;
};

/// The commands of a trial, tick by tick.
class CommandSchedule {
 public:
  struct Stretch {
    int first_tick = 0;  ///< from 0
    Command command;
  };

  /// The first stretch begins with tick 0, the others later, in order. A command changes linearly in
  /// `ramp_ticks` ticks from what it was in the tick before its stretch, and from rest.
  CommandSchedule(std::vector<Stretch> stretches, int ramp_ticks);

  /// The command in a tick, from 0 on. Single precision, each operation rounded.
  Command at(int tick) const;
  /// From this tick on another command to the end, in place of what was to come.
  void change(int tick, Command command);
  const std::vector<Stretch>& stretches() const { return stretches_; }

 private:
  std::vector<Stretch> stretches_;
  int ramp_ticks_;
};

/// The schedule of trials in which nothing is drawn: that of `stretches`; nothing if there are no commands.
std::optional<CommandSchedule> planned_commands(const CommandSettings& settings, int steps,
                                                double timestep_s);
/// By chance (CommandKind::random). A longer trial begins as a shorter one of the same stream. `mirror`: all
/// turns the other way round.
CommandSchedule drawn_commands(const CommandSettings& settings, int steps, double timestep_s, Stream stream,
                               bool mirror);

/// Stretches in one line, "SPEED,TURN[,SECONDS]; …". Throws UserError.
std::vector<CommandStretch> parse_commands(std::string_view text);

}  // namespace amble::trial
