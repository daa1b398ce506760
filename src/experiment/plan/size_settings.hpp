#pragma once

#include <optional>

#include "amble/robot/spec.hpp"

namespace amble::experiment {

/// Settings for a robot of another size than the presets' quadruped, by Froude's rule: times go with the
/// square root of the legs' height over gravity, speeds with that of the legs' height times gravity. None for
/// a robot of about that size, unless its servos follow late: a period is three times what they take, in
/// which a swing still reaches four tenths of its targets, but at most 5 s.
struct SizeSettings {
  double leg_height_m = 0.0, preset_leg_height_m = 0.0;
  double period_s = 0.0, push_m_s = 0.0, start_height_m = 0.0;
  double servo_lag_s = 0.0;  ///< > 0: what the servos take to follow, which sets the period and not the size
};
std::optional<SizeSettings> settings_of_size(const robot::RobotSpec& robot);

/// The greatest commands for a robot, by the height of its hips over its feet (Froude): a brisk walk, and
/// half a circle in the time of nineteen periods of settings_of_size(). None for fewer than three legs.
struct CommandSizes {
  double leg_height_m = 0.0, most_speed_m_s = 0.0, most_turn_rad_s = 0.0;
};
std::optional<CommandSizes> commands_of_size(const robot::RobotSpec& robot);

}  // namespace amble::experiment
