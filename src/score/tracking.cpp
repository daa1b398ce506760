#include "amble/score/tracking.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "amble/score/direction.hpp"

namespace amble::score {
namespace {

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

double yaw_rate(const record::Trajectory& trajectory, const Context&) {
  return trajectory.steps > 0 ? trajectory.turned_rad / trajectory.seconds() : 0.0;
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

}  // namespace amble::score
