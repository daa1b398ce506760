#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "amble/core/random.hpp"
#include "amble/io/settings.hpp"
#include "amble/trial/settings.hpp"

namespace amble::trial {

/// Where the commands of a trial come from.
enum class CommandKind {
  none,   ///< there are none
  fixed,  ///< the list of stretches
  random  ///< drawn by chance, the same for all genomes of a generation
};
/// As configs write them, by CommandKind.
inline constexpr std::array<std::string_view, 3> command_kind_names{"none", "fixed", "random"};

/// A stretch of time in which the command stays as it is.
struct CommandStretch {
  double speed_m_s = 0.0;   ///< along the robot's own forward axis, −100 … 100; negative: backwards
  double turn_rad_s = 0.0;  ///< to the left, −100 … 100
  /// How long, 0 … 1e6. 0: with the others of 0, an equal share of the rest of the trial.
  double seconds = 0.0;

  void describe(io::SettingsVisitor& visitor);  ///< an item of command.stretches
  friend bool operator==(const CommandStretch&, const CommandStretch&) = default;
};

/// What robots are told to do in trials: by default nothing. A CommandSchedule comes of it. Ranges are those
/// that describe() holds a config to.
struct CommandSettings {
  CommandKind kind = CommandKind::none;  ///< where commands come from
  /// What is commanded, one after the other; the last goes on to the end. With CommandKind::random: used in
  /// trials in which nothing is drawn; empty: straight ahead, to the left, to the right and a stop.
  std::vector<CommandStretch> stretches = {};
  double ramp_s = 0.0;  ///< time in which a command changes, from rest or the one before, 0 … 1e6; 0: at once
  // For CommandKind::random:
  double stretch_s = 5.0;        ///< length of each stretch, 0.001 … 1e6, at least one timestep
  double least_speed_m_s = 0.0,  ///< slowest speed, −100 … 100
      most_speed_m_s = 0.4;      ///< fastest speed, likewise; uniform in between
  double most_turn_rad_s = 0.5;  ///< fastest turn to either side, 0 … 100; uniform in between
  double straight_share = 0.2,   ///< probability that it is a speed without a turn, 0 … 1
      stop_share = 0.1;          ///< probability that it is a stop, 0 … 1; both together at most 1
  bool mirrored = true;          ///< whether every second trial turns as the one before it, to the other side

  void describe(io::SettingsVisitor& visitor);  ///< the table [command]
  /// Throws SettingError: nothing listed, or lists and shares that leave no time or make no sense.
  void validate(const Settings& trial) const;
  /// Whether all settings are at their defaults.
  bool is_default() const { return *this == CommandSettings(); }
  /// Whether trials differ by their commands.
  bool varies() const { return kind == CommandKind::random; }
  friend bool operator==(const CommandSettings&, const CommandSettings&) = default;
};

/// What a robot is told.
struct Command {
  float speed_m_s = 0.0f;   ///< along its own forward axis
  float turn_rad_s = 0.0f;  ///< to the left

  /// Whether it is to stand still.
  bool is_stop() const { return speed_m_s == 0.0f && turn_rad_s == 0.0f; }
  friend bool operator==(const Command&, const Command&) = default;
};

/// The commands of a trial, tick by tick.
class CommandSchedule {
 public:
  /// What is commanded from a tick on.
  struct Stretch {
    int first_tick = 0;  ///< counted from 0
    Command command;     ///< what it comes to, after the ramp
  };

  /// The first stretch begins with tick 0 (AMBLE_CHECK), the others later, in order. A command changes
  /// linearly in `ramp_ticks` ticks from what it was in the tick before its stretch, and from rest.
  CommandSchedule(std::vector<Stretch> stretches, int ramp_ticks);

  /// The command in a tick, from 0 on. Single precision, each operation rounded.
  Command at(int tick) const;
  /// From this tick on, at least 0 (AMBLE_CHECK), another command to the end, in place of what was to come.
  void change(int tick, Command command);
  /// In order, with those that change() added.
  const std::vector<Stretch>& stretches() const { return stretches_; }

 private:
  std::vector<Stretch> stretches_;
  int ramp_ticks_;
};

/// The schedule of trials of so many steps in which nothing is drawn: that of `stretches`; nothing with
/// CommandKind::none. The settings must be valid.
std::optional<CommandSchedule> planned_commands(const CommandSettings& settings, int steps,
                                                double timestep_s);
/// By chance (CommandKind::random). A longer trial begins as a shorter one of the same stream. `mirror`: all
/// turns the other way round.
CommandSchedule drawn_commands(const CommandSettings& settings, int steps, double timestep_s, Stream stream,
                               bool mirror);

/// Stretches in one line, "SPEED,TURN[,SECONDS]; …", in the units of CommandStretch. Throws UserError,
/// which names the command, for another form and numbers beyond the ranges of CommandStretch.
std::vector<CommandStretch> parse_commands(std::string_view text);

}  // namespace amble::trial
