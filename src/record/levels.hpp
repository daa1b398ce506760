#pragma once

#include <span>
#include <string>
#include <string_view>

namespace amble::record {

/// A named amount of disturbance. At one of these levels amble asks what a walker typically does: a single
/// undisturbed trial is one exact trajectory, which a micro-radian can turn into another
/// (docs/GAITS-NOT-TRAJECTORIES.md); trial::noise_of() makes noise of it.
struct Level {
  std::string_view name;
  std::string_view meaning;
  /// The start: each joint, roll and pitch turned by up to ± so much, rad; dropped from up to a tenth of it,
  /// m.
  double start_rad = 0.0;
  double push_m_s = 0.0;  ///< pushes: largest impulse divided by the robot's mass, m/s
};

/// All levels, weakest first: `control`, which must not change a bit, `micro`, `100-micro`, `milli`.
std::span<const Level> levels();
/// Nothing if there is none of that name.
const Level* find_level(std::string_view name);
/// "control, micro, 100-micro or milli", for messages.
std::string level_names();

/// What takes a level's place where the noise is that of a walker's own evolution.
inline constexpr std::string_view own_noise = "own";

/// The level at which the champions of runs without noise of their own are judged.
inline constexpr std::string_view default_level = "milli";

}  // namespace amble::record
