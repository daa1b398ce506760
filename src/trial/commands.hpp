#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "amble/core/random.hpp"
#include "amble/trial/command_settings.hpp"

namespace amble::trial {

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
  /// `ramp_ticks` ticks from the command of the stretch before, and from rest.
  CommandSchedule(std::vector<Stretch> stretches, int ramp_ticks);

  /// Of a tick from 0 on. Single precision, each operation rounded.
  Command at(int tick) const;
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
