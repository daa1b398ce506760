#pragma once

#include <array>
#include <string_view>

#include "amble/core/math.hpp"
#include "amble/io/settings.hpp"

namespace amble::ground {

/// What is on the ground. Squares are aligned with x and y and concentric about the origin.
enum class Kind {
  plane,    ///< nothing
  hills,    ///< smooth: three octaves of value noise, the longest `length_m`
  rough,    ///< a random height every `length_m`, straight between them
  stones,   ///< square plateaus of random heights, `length_m` wide
  blocks,   ///< half of the squares of `length_m`, at random, have a box half as wide, `height_m` high
  stairs,   ///< steps up and down again, `height_m` high and `length_m` deep
  hurdles,  ///< walls 0.08 m thick, `height_m` high, one every `length_m`
};
inline constexpr std::array<std::string_view, 7> kind_names{"plane",  "hills",  "rough",  "stones",
                                                            "blocks", "stairs", "hurdles"};

/// When the ground changes.
enum class Vary { never, generations };
inline constexpr std::array<std::string_view, 2> vary_names{"never", "generations"};

/// The ground that robots walk on, as part of an experiment. By default the plane z = 0 with the friction of
/// the robot's file.
struct Settings {
  Kind kind = Kind::plane;
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

  void describe(io::SettingsVisitor& visitor);
  /// Rules that involve several settings. Throws SettingError.
  void validate() const;

  bool is_default() const;
  bool has_field() const { return kind != Kind::plane; }
  /// Whether heights follow from the distance to the flat start alone, not from random numbers.
  bool concentric() const { return kind == Kind::stairs || kind == Kind::hurdles; }
  /// The direction of `gravity_m_s2` (straight down, any magnitude) as seen from the plane of the ground,
  /// which stays z = 0: on a slope the world's z axis is the plane's normal.
  Vec3 tilted(Vec3 gravity_m_s2) const;
};

}  // namespace amble::ground
