#include "amble/score/tracking.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace amble::score {
namespace {

/// Cosine and sine of an angle of at most 45 degrees, by their Taylor series up to the last bit. The
/// library's functions have other last bits on other CPUs.
Direction small_turn(double angle_rad) {
  Direction turn{1.0, angle_rad};
  double cosine_term = 1.0, sine_term = angle_rad;
  for (int n = 2; n <= 20; n += 2) {
    cosine_term *= -angle_rad * angle_rad / (n * (n - 1));
    sine_term *= -angle_rad * angle_rad / (n * (n + 1));
    turn.x += cosine_term;
    turn.y += sine_term;
  }
  return turn;
}

constexpr double degrees = 180.0 / std::numbers::pi;

/// A whole second of a trial.
struct Second {
  double along_m_s = 0.0, across_m_s = 0.0;  ///< of the robot's forward axis in its middle
  double turned_rad = 0.0;                   ///< in it
  double speed_m_s = 0.0, turn_rad_s = 0.0;  ///< commanded

  bool is_stop() const { return speed_m_s == 0.0 && turn_rad_s == 0.0; }
  double speed_error_m_s() const {
    const double along = along_m_s - speed_m_s;
    return std::sqrt(along * along + across_m_s * across_m_s);
  }
  double turn_error_rad_s() const { return std::abs(turned_rad - turn_rad_s); }
  bool follows() const {
    return speed_error_m_s() <= followed_speed_m_s && turn_error_rad_s() <= followed_turn_rad_s;
  }
  bool has_command_of(const Second& other) const {
    return speed_m_s == other.speed_m_s && turn_rad_s == other.turn_rad_s;
  }
};

std::vector<Second> seconds_of(const record::Trajectory& trajectory) {
  const auto& path_m = trajectory.com_by_second_m;
  const auto& turned_rad = trajectory.turned_by_second_rad;
  const auto& commands = trajectory.command_by_second;
  std::vector<Second> seconds(std::min(path_m.size() / 2, turned_rad.size()));
  double x_m = 0.0, y_m = 0.0, heading_rad = 0.0;
  for (std::size_t k = 0; k < seconds.size(); ++k) {
    Second& second = seconds[k];
    const Direction f = turned(trajectory, 0.5 * (heading_rad + turned_rad[k]) * degrees);
    const double moved_x_m = path_m[2 * k] - x_m, moved_y_m = path_m[2 * k + 1] - y_m;
    second.along_m_s = along(f, moved_x_m, moved_y_m);
    second.across_m_s = along({-f.y, f.x}, moved_x_m, moved_y_m);
    second.turned_rad = turned_rad[k] - heading_rad;
    if (2 * k + 1 < commands.size()) {
      second.speed_m_s = commands[2 * k];
      second.turn_rad_s = commands[2 * k + 1];
    }
    x_m = path_m[2 * k];
    y_m = path_m[2 * k + 1];
    heading_rad = turned_rad[k];
  }
  return seconds;
}

template <typename Value>
double mean_of(const std::vector<Second>& seconds, Value value) {
  double sum = 0.0;
  for (const Second& second : seconds) sum += value(second);
  return seconds.empty() ? 0.0 : sum / static_cast<double>(seconds.size());
}

double closeness(double error, double wanted, double least) {
  return std::max(0.0, 1.0 - error / std::max(std::abs(wanted), least));
}

double both(const Second& second, const TrackingSettings& settings) {
  return 0.5 * (closeness(second.speed_error_m_s(), second.speed_m_s, settings.speed_m_s) +
                closeness(second.turn_error_rad_s(), second.turn_rad_s, settings.turn_rad_s));
}

/// What a second counts in which the robot is to move.
double above_standing(const Second& second, const TrackingSettings& settings) {
  const Second standing{.speed_m_s = second.speed_m_s, .turn_rad_s = second.turn_rad_s};
  const double without = both(standing, settings);
  // Next to nothing is commanded, and standing still is as good as anything.
  if (without >= 1.0) return 0.0;
  return std::max(0.0, (both(second, settings) - without) / (1.0 - without));
}

}  // namespace

Direction unit_direction(double angle_deg) {
  const double quarters = std::nearbyint(angle_deg / 90.0);
  Direction turn = small_turn((angle_deg - 90.0 * quarters) * (std::numbers::pi / 180.0));
  for (int i = 0; i < (static_cast<int>(quarters) % 4 + 4) % 4; ++i) turn = {-turn.y, turn.x};
  return turn;
}

Direction turned(const record::Trajectory& trajectory, double angle_deg) {
  const Direction turn = unit_direction(angle_deg);
  const Direction forward{trajectory.forward_x, trajectory.forward_y};
  return {forward.x * turn.x - forward.y * turn.y, forward.x * turn.y + forward.y * turn.x};
}

/// By the series of the arc tangent: as small_turn(), not by the library's function.
double angle_deg(Direction direction) {
  const double x = std::abs(direction.x), y = std::abs(direction.y);
  const double low = std::min(x, y), high = std::max(x, y);
  if (high == 0.0) return 0.0;
  // The series of the half angle, whose tangent is at most tan 22.5° = 0.41: tan(φ/2) = sin φ / (1 + cos φ).
  const double tangent = low / (high + std::sqrt(low * low + high * high));
  double sum = 0.0, power = tangent;
  for (int n = 1; n <= 41; n += 2) {
    sum += (n % 4 == 1 ? power : -power) / n;
    power *= tangent * tangent;
  }
  double angle = 2.0 * sum * (180.0 / std::numbers::pi);
  if (y > x) angle = 90.0 - angle;
  if (direction.x < 0.0) angle = 180.0 - angle;
  return direction.y < 0.0 ? -angle : angle;
}

double yaw_rate(const record::Trajectory& trajectory, const Context&) {
  return trajectory.steps > 0 ? trajectory.turned_rad / trajectory.seconds() : 0.0;
}

double own_speed(const record::Trajectory& trajectory, const Context&) {
  return mean_of(seconds_of(trajectory), [](const Second& second) { return second.along_m_s; });
}

double speed_error(const record::Trajectory& trajectory, const Context&) {
  return mean_of(seconds_of(trajectory), [](const Second& second) { return second.speed_error_m_s(); });
}

double turn_error(const record::Trajectory& trajectory, const Context&) {
  return mean_of(seconds_of(trajectory), [](const Second& second) { return second.turn_error_rad_s(); });
}

double heading_error(const record::Trajectory& trajectory, const Context&) {
  double behind_rad = 0.0;
  return mean_of(seconds_of(trajectory), [&](const Second& second) {
    behind_rad += second.turned_rad - second.turn_rad_s;
    return std::abs(behind_rad);
  });
}

double tracking(const record::Trajectory& trajectory, const Context& context) {
  const int whole = record::second_count(context.duration_s);
  if (whole == 0) return 0.0;
  double moving = 0.0, stops = 0.0;
  int moving_seconds = 0;
  for (const Second& second : seconds_of(trajectory)) {
    if (second.is_stop()) {
      stops += both(second, context.settings.tracking);
    } else {
      moving += above_standing(second, context.settings.tracking);
      ++moving_seconds;
    }
  }
  const bool only_stops = moving_seconds == 0 && trajectory.outcome == record::Outcome::completed;
  const double moving_mean = only_stops ? 1.0 : moving / std::max(moving_seconds, 1);
  return std::clamp((moving + stops * moving_mean) / whole, 0.0, 1.0);
}

std::optional<double> switch_s(const record::Trajectory& trajectory, const Context& context) {
  std::vector<Second> seconds = seconds_of(trajectory);
  const std::size_t lasted = seconds.size();
  const auto& commands = trajectory.command_by_second;
  for (std::size_t k = lasted; 2 * k + 1 < commands.size(); ++k)
    seconds.push_back({.speed_m_s = commands[2 * k], .turn_rad_s = commands[2 * k + 1]});
  std::size_t waited = 0, changes = 0;
  bool waits = false, changed_before = false;
  for (std::size_t k = 0; k < seconds.size(); ++k) {
    const bool changes_now = k == 0 ? !seconds[k].is_stop() : !seconds[k].has_command_of(seconds[k - 1]);
    // A change that goes on from the second before is a ramp: still the same one.
    if (changes_now && !(waits && changed_before)) {
      waits = true;
      ++changes;
    }
    changed_before = changes_now;
    if (waits && k < lasted && seconds[k].follows()) waits = false;
    if (waits) ++waited;
  }
  if (changes == 0) return std::nullopt;
  const auto whole = static_cast<std::size_t>(record::second_count(context.duration_s));
  if (waits && whole > seconds.size()) waited += whole - seconds.size();
  return static_cast<double>(waited) / static_cast<double>(changes);
}

}  // namespace amble::score
