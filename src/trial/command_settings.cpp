#include "amble/trial/command_settings.hpp"

#include <algorithm>

#include "amble/core/error.hpp"

namespace amble::trial {
namespace {

constexpr io::Range speed_range{-100.0, 100.0}, turn_range{-100.0, 100.0}, share_range{0.0, 1.0};

}  // namespace

void CommandStretch::describe(io::SettingsVisitor& visitor) {
  visitor.number("speed_m_s", speed_m_s, speed_range,
                 {"speed along the robot's own forward axis, m/s; negative: backwards"});
  visitor.number("turn_rad_s", turn_rad_s, turn_range, {"rate of turning to the left, rad/s"});
  visitor.number("seconds", seconds, {0.0, 1e6},
                 {"how long, s; 0: an equal share of the time that the others leave of the trial"});
}

void CommandSettings::describe(io::SettingsVisitor& visitor) {
  visitor.choice(
      "kind", kind, command_kind_names,
      {"whether robots are told nothing (none), the stretches below (fixed), or what is drawn by chance, the "
       "same for all genomes of a generation (random)"});
  visitor.tables("stretches", stretches,
                 {"what is commanded, one after the other; the last goes on to the end. Of random: in trials "
                  "without anything by chance; without a list straight ahead, to the left, to the right and "
                  "a stop"});
  visitor.number("ramp_s", ramp_s, {0.0, 1e6},
                 {"time in which a command changes, from rest or from the one before, s; 0: at once"});
  visitor.number("stretch_s", stretch_s, {1e-3, 1e6}, {"random: length of each stretch, s"});
  visitor.number("least_speed_m_s", least_speed_m_s, speed_range, {"random: slowest speed, m/s"});
  visitor.number("most_speed_m_s", most_speed_m_s, speed_range, {"random: fastest speed, m/s"});
  visitor.number("most_turn_rad_s", most_turn_rad_s, {0.0, 100.0},
                 {"random: fastest turn, to the left and to the right, rad/s"});
  visitor.number("straight_share", straight_share, share_range,
                 {"random: share of stretches without a turn"});
  visitor.number("stop_share", stop_share, share_range, {"random: share of stretches that are a stop"});
  visitor.flag("mirrored", mirrored,
               {"random: whether every second trial has the turns of the one before it to the other side"});
}

void CommandSettings::validate(const Settings& trial) const {
  if (kind == CommandKind::none) return;
  if (kind == CommandKind::fixed && stretches.empty())
    fail_setting({"command.stretches", "command.kind"},
                 "command.stretches is empty: command.kind = \"fixed\" needs a list, e.g. [{{ speed_m_s = "
                 "0.4 }}, {{ speed_m_s = 0.4, turn_rad_s = 0.5 }}]");
  double listed_s = 0.0;
  for (const CommandStretch& stretch : stretches) listed_s += stretch.seconds;
  const bool shares =
      std::ranges::any_of(stretches, [](const CommandStretch& s) { return s.seconds == 0.0; });
  if (shares && listed_s >= trial.duration_s)
    fail_setting({"command.stretches", "trial.duration_s"},
                 "command.stretches: {} s of them leave nothing of a trial of {} s for those without seconds",
                 listed_s, trial.duration_s);
  if (least_speed_m_s > most_speed_m_s)
    fail_setting({"command.least_speed_m_s", "command.most_speed_m_s"},
                 "command.least_speed_m_s = {}: expected at most command.most_speed_m_s = {}",
                 least_speed_m_s, most_speed_m_s);
  if (straight_share + stop_share > 1.0)
    fail_setting({"command.stop_share", "command.straight_share"},
                 "command.straight_share + command.stop_share = {}: expected at most 1",
                 straight_share + stop_share);
  if (kind == CommandKind::random && stretch_s < trial.timestep_s)
    fail_setting({"command.stretch_s", "trial.timestep_s"},
                 "command.stretch_s = {}: expected at least one timestep, {} s", stretch_s, trial.timestep_s);
}

}  // namespace amble::trial
