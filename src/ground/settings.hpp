#pragma once

#include <array>
#include <string>
#include <string_view>

#include "amble/core/math.hpp"
#include "amble/io/own_settings.hpp"
#include "amble/io/settings.hpp"

namespace amble::ground {

/// When the ground changes.
enum class Vary { never, generations };
inline constexpr std::array<std::string_view, 2> vary_names{"never", "generations"};

/// The ground that robots walk on, as part of an experiment. By default the plane z = 0 with the friction of
/// the robot's file.
struct Settings {
  std::string kind = "plane";  ///< the name of a Kind (kinds.hpp)
  double height_m = 0.05;
  double length_m = 0.5;
  double cell_m = 0.04;
  double start_radius_m = 0.6;
  double start_place_m = 0.0;
  double slope_x = 0.0, slope_y = 0.0;
  double friction = -1.0;
  int seed = 1;
  Vary vary = Vary::never;
  int grow_generations = 0;
  io::OwnSettings own = {};  ///< of a kind that a program or a plugin has added

  void describe(io::SettingsVisitor& visitor);
  /// Rules that involve several settings. Throws SettingError.
  void validate() const;

  bool is_default() const;
  bool has_field() const { return kind != "plane"; }
  /// Kind::concentric
  bool concentric() const;
  /// The direction of `gravity_m_s2` (straight down, any magnitude) as seen from the plane of the ground,
  /// which stays z = 0: on a slope the world's z axis is the plane's normal.
  Vec3 tilted(Vec3 gravity_m_s2) const;
};

}  // namespace amble::ground
