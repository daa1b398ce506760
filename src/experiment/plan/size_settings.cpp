#include "amble/experiment/plan/size_settings.hpp"

#include <algorithm>
#include <cmath>

#include "amble/robot/legs.hpp"

namespace amble::experiment {
namespace {

/// The quadruped for which the presets' times and speeds are: the height of its hips over its feet.
constexpr double preset_leg_height_m = 0.88;
constexpr double preset_gravity_m_s2 = 9.8, preset_period_s = 1.0, preset_push_m_s = 0.2,
                 preset_drop_m = 0.01;

}  // namespace

std::optional<SizeSettings> settings_of_size(const robot::RobotSpec& robot) {
  const double height_m = robot::leg_height_m(robot), gravity_m_s2 = norm(robot.gravity_m_s2);
  if (!(height_m > 0.0) || !(gravity_m_s2 > 0.0)) return std::nullopt;
  const double size = height_m / preset_leg_height_m, pull = gravity_m_s2 / preset_gravity_m_s2;
  const double time = std::sqrt(size / pull);
  constexpr double alike = 0.15;
  if (std::abs(time - 1.0) < alike) return std::nullopt;
  return SizeSettings{.leg_height_m = height_m,
                      .preset_leg_height_m = preset_leg_height_m,
                      .period_s = std::clamp(std::round(100.0 * preset_period_s * time) / 100.0, 0.05, 5.0),
                      .push_m_s = preset_push_m_s * std::sqrt(size * pull),
                      .start_height_m = preset_drop_m * size};
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
