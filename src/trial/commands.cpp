#include "amble/trial/commands.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/io/text.hpp"

namespace amble::trial {
namespace {

constexpr double longest_s = 1e6;
constexpr io::Range speed_range{-100.0, 100.0}, turn_range{-100.0, 100.0}, share_range{0.0, 1.0},
    seconds_range{0.0, longest_s};

/// At most as many as the longest trial has; the sum of two is a number, too.
int ticks_of(double time_s, double timestep_s) {
  return static_cast<int>(std::lround(std::min(time_s / timestep_s, 1e9)));
}

Command command_of(const CommandStretch& stretch) {
  return {static_cast<float>(stretch.speed_m_s), static_cast<float>(stretch.turn_rad_s)};
}

/// Straight ahead, to the left, to the right, and a stop.
std::vector<CommandStretch> all_round(const CommandSettings& settings) {
  const double speed_m_s = settings.most_speed_m_s, turn_rad_s = settings.most_turn_rad_s;
  return {{speed_m_s, 0.0}, {speed_m_s, turn_rad_s}, {speed_m_s, -turn_rad_s}, {0.0, 0.0}};
}

/// Nothing for what is no number; infinity for one that is too large.
std::optional<double> number_of(std::string_view text) {
  double value = 0.0;
#ifdef __cpp_lib_to_chars
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range) value = HUGE_VAL;
  const bool whole = error != std::errc::invalid_argument && end == text.data() + text.size();
#else
  // The standard library for WebAssembly reads no floating point in this way, and has one locale only.
  char* end = nullptr;
  const std::string copy(text);
  value = std::strtod(copy.c_str(), &end);
  const bool whole = !copy.empty() && end == copy.c_str() + copy.size();
#endif
  return whole ? std::optional(value) : std::nullopt;
}

/// Throws UserError: not in its range, or no number at all.
void check_range(std::string_view command, const char* name, const char* unit, double value,
                 const io::Range& range) {
  if (value >= range.lowest && value <= range.highest) return;
  fail(ExitCode::bad_input, "command \"{}\": {} = {}: expected a number from {} to {} ({})",
       io::printable(std::string(command)), name, value, range.lowest, range.highest, unit);
}

/// `part`: a command of `text`.
CommandStretch parse_command(std::string_view part, std::string_view text) {
  std::vector<double> numbers;
  const auto words = io::split(part, ',');
  for (const std::string_view word : words)
    if (const auto number = number_of(io::trimmed(word))) numbers.push_back(*number);
  if (numbers.size() != words.size() || words.size() < 2 || words.size() > 3)
    fail(ExitCode::bad_input,
         "command \"{}\": expected SPEED,TURN or SPEED,TURN,SECONDS (m/s, rad/s to the left, s) with a "
         "semicolon between two commands, e.g. \"0.4,0; 0.4,0.5; 0,0\"",
         io::printable(std::string(part.empty() ? text : part)));
  const CommandStretch stretch{numbers[0], numbers[1], words.size() == 3 ? numbers[2] : 0.0};
  check_range(part, "speed", "m/s", stretch.speed_m_s, speed_range);
  check_range(part, "turn", "rad/s to the left", stretch.turn_rad_s, turn_range);
  check_range(part, "seconds", "s; 0 or none: a share of what the others leave", stretch.seconds,
              seconds_range);
  return stretch;
}

}  // namespace

void CommandStretch::describe(io::SettingsVisitor& visitor) {
  visitor.number("speed_m_s", speed_m_s, speed_range,
                 {"speed along the robot's own forward axis, m/s; negative: backwards"});
  visitor.number("turn_rad_s", turn_rad_s, turn_range, {"rate of turning to the left, rad/s"});
  visitor.number("seconds", seconds, seconds_range,
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
  visitor.number("ramp_s", ramp_s, {0.0, longest_s},
                 {"time in which a command changes, from rest or from the one before, s; 0: at once"});
  visitor.number("stretch_s", stretch_s, {1e-3, longest_s}, {"random: length of each stretch, s"});
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

CommandSchedule::CommandSchedule(std::vector<Stretch> stretches, int ramp_ticks)
    : stretches_(std::move(stretches)), ramp_ticks_(ramp_ticks) {
  AMBLE_CHECK(!stretches_.empty() && stretches_.front().first_tick == 0, "a schedule begins with tick 0");
}

Command CommandSchedule::at(int tick) const {
  std::size_t i = 0;
  while (i + 1 < stretches_.size() && stretches_[i + 1].first_tick <= tick) ++i;
  const Command now = stretches_[i].command;
  const int done = tick - stretches_[i].first_tick + 1;
  if (done >= ramp_ticks_) return now;
  const Command before = i > 0 ? at(stretches_[i].first_tick - 1) : Command();
  const float share = static_cast<float>(done) / static_cast<float>(ramp_ticks_);
  return {before.speed_m_s + share * (now.speed_m_s - before.speed_m_s),
          before.turn_rad_s + share * (now.turn_rad_s - before.turn_rad_s)};
}

void CommandSchedule::change(int tick, Command command) {
  AMBLE_CHECK(tick >= 0, "ticks count from 0");
  while (!stretches_.empty() && stretches_.back().first_tick >= tick) stretches_.pop_back();
  stretches_.push_back({tick, command});
}

std::optional<CommandSchedule> planned_commands(const CommandSettings& settings, int steps,
                                                double timestep_s) {
  if (settings.kind == CommandKind::none) return std::nullopt;
  const auto list = settings.stretches.empty() ? all_round(settings) : settings.stretches;
  double listed_s = 0.0, shares = 0.0;
  for (const CommandStretch& stretch : list) {
    listed_s += stretch.seconds;
    shares += stretch.seconds == 0.0 ? 1.0 : 0.0;
  }
  const double share_s = (steps * timestep_s - listed_s) / std::max(shares, 1.0);
  std::vector<CommandSchedule::Stretch> stretches;
  double begin_s = 0.0;
  for (const CommandStretch& stretch : list) {
    const int first_tick = ticks_of(begin_s, timestep_s);
    // Where two begin with the same tick, the first has no time.
    if (!stretches.empty() && stretches.back().first_tick == first_tick) stretches.pop_back();
    stretches.push_back({first_tick, command_of(stretch)});
    begin_s += stretch.seconds > 0.0 ? stretch.seconds : std::max(share_s, 0.0);
  }
  return CommandSchedule(std::move(stretches), ticks_of(settings.ramp_s, timestep_s));
}

CommandSchedule drawn_commands(const CommandSettings& settings, int steps, double timestep_s, Stream stream,
                               bool mirror) {
  const int length = std::max(1, ticks_of(settings.stretch_s, timestep_s));
  std::vector<CommandSchedule::Stretch> stretches;
  for (int first = 0; first < steps || first == 0; first += length) {
    const double kind = stream.uniform();
    CommandStretch drawn{.speed_m_s = stream.uniform(settings.least_speed_m_s, settings.most_speed_m_s),
                         .turn_rad_s = stream.uniform(-settings.most_turn_rad_s, settings.most_turn_rad_s)};
    if (kind < settings.stop_share) drawn = {};
    if (kind < settings.stop_share + settings.straight_share) drawn.turn_rad_s = 0.0;
    if (mirror) drawn.turn_rad_s = 0.0 - drawn.turn_rad_s;
    stretches.push_back({first, command_of(drawn)});
  }
  return {std::move(stretches), ticks_of(settings.ramp_s, timestep_s)};
}

std::vector<CommandStretch> parse_commands(std::string_view text) {
  std::vector<CommandStretch> stretches;
  for (const std::string_view part : io::split(text, ';'))
    stretches.push_back(parse_command(io::trimmed(part), text));
  return stretches;
}

}  // namespace amble::trial
