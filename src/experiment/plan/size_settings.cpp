#include "amble/experiment/plan/size_settings.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "amble/robot/legs.hpp"
#include "amble/statistics/descriptive.hpp"

namespace amble::experiment {
namespace {

/// The quadruped for which the presets' times and speeds are: the height of its hips over its feet.
constexpr double preset_leg_height_m = 0.88;
constexpr double preset_gravity_m_s2 = 9.8, preset_period_s = 1.0, preset_push_m_s = 0.2,
                 preset_drop_m = 0.01;
constexpr double least_period_s = 0.05, most_period_s = 5.0;
constexpr double lags_of_a_period = 3.0;

/// The time constant with which a servo comes near its target, without inertia, the median over the motors; 0
/// without motors, and for those without a gain.
double servo_lag_s(const robot::RobotSpec& robot) {
  std::vector<double> lags_s;
  for (const robot::Joint& joint : robot.joints) {
    if (!joint.driven()) continue;
    const robot::Servo& servo = joint.servo;
    const bool by_torque = servo.mode == robot::ServoMode::torque;
    const double gain = by_torque ? servo.kp_nm_per_rad : servo.gain_per_s,
                 slowness = by_torque ? servo.kd_nm_s_per_rad + joint.damping_nm_s_per_rad : 1.0;
    lags_s.push_back(gain > 0.0 ? slowness / gain : 0.0);
  }
  return lags_s.empty() ? 0.0 : statistics::median(lags_s);
}

double rounded(double period_s) {
  return std::clamp(std::round(100.0 * period_s) / 100.0, least_period_s, most_period_s);
}

}  // namespace

std::optional<SizeSettings> settings_of_size(const robot::RobotSpec& robot) {
  const double height_m = robot::leg_height_m(robot), gravity_m_s2 = norm(robot.gravity_m_s2);
  if (!(height_m > 0.0) || !(gravity_m_s2 > 0.0)) return std::nullopt;
  const double size = height_m / preset_leg_height_m, pull = gravity_m_s2 / preset_gravity_m_s2;
  const double time = std::sqrt(size / pull);
  const double lag_s = servo_lag_s(robot);
  const bool late = lags_of_a_period * lag_s > preset_period_s * time;
  constexpr double alike = 0.15;
  if (std::abs(time - 1.0) < alike && !late) return std::nullopt;
  return SizeSettings{.leg_height_m = height_m,
                      .preset_leg_height_m = preset_leg_height_m,
                      .period_s = rounded(late ? lags_of_a_period * lag_s : preset_period_s * time),
                      .push_m_s = preset_push_m_s * std::sqrt(size * pull),
                      .start_height_m = preset_drop_m * size,
                      .servo_lag_s = late ? lag_s : 0.0};
}

std::optional<CommandSizes> commands_of_size(const robot::RobotSpec& robot) {
  const double height_m = robot::leg_height_m(robot), gravity_m_s2 = norm(robot.gravity_m_s2);
  if (!(height_m > 0.0) || !(gravity_m_s2 > 0.0) || robot.legs.size() < 3) return std::nullopt;
  const auto rounded = [](double value) { return std::max(std::round(100.0 * value) / 100.0, 0.01); };
  return CommandSizes{.leg_height_m = height_m,
                      .most_speed_m_s = rounded(0.2 * std::sqrt(gravity_m_s2 * height_m)),
                      .most_turn_rad_s = rounded(0.05 * std::sqrt(gravity_m_s2 / height_m))};
}

}  // namespace amble::experiment
