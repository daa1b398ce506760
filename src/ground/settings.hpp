#pragma once

#include <array>
#include <string>
#include <string_view>

#include "amble/core/math.hpp"
#include "amble/io/own_settings.hpp"
#include "amble/io/settings.hpp"

/// What robots walk on: kinds of ground, and contacts with it.
namespace amble::ground {

/// When the ground changes.
enum class Vary {
  never,       ///< evolution has one ground in all generations and runs, which `grow_generations` still
               ///< raises; grounds unseen in evolution (Key::set) differ by run
  generations  ///< each generation of a run has another; evaluation.draw = "once" keeps the first
};
/// As configs write them, by Vary.
inline constexpr std::array<std::string_view, 2> vary_names{"never", "generations"};
/// Thickness of the walls of `hurdles`.
inline constexpr double hurdle_m = 0.08;

/// The ground that robots walk on, as part of an experiment. By default the plane z = 0 with the friction of
/// the robot's file. Ranges are those that describe() holds a config to. On the plane only `start_place_m`,
/// slopes and `friction` count.
struct Settings {
  std::string kind = "plane";  ///< the name of a Kind (kinds.hpp)
  /// hills, rough, stones: heights lie within ± half of this, which hills rarely reach; else height of one
  /// step or obstacle. 0 … 10.
  double height_m = 0.05;
  /// hills: wavelength; else distance from one step, stone or obstacle to the next. 0.01 … 100, at least two
  /// cells.
  double length_m = 0.5;
  double cell_m = 0.04;         ///< grid of heights, 0.005 … 1; the ground repeats after 256 cells
  double start_radius_m = 0.6;  ///< flat, at height 0, so far around the origin, 0 … 100
  double start_place_m = 0.0;   ///< trials start up to ± this from the origin along x and y, 0 … 1000
  double slope_x = 0.0,         ///< rise along x, m per m, −10 … 10
      slope_y = 0.0;            ///< rise along y, likewise
  double friction = -1.0;       ///< Coulomb coefficient, 0 … 1e6; −1: that of the robot's file
  int seed = 1;                 ///< names one of all grounds of these settings, at least 0
  Vary vary = Vary::never;      ///< when it is another
  int grow_generations = 0;  ///< generations in which heights grow from 0 to height_m, 0 … 1e9; 0: at once
  io::OwnSettings own = {};  ///< a kind that a program or a plugin has added

  /// The table [ground]. AMBLE_CHECK: the kind is known, as it is after reading.
  void describe(io::SettingsVisitor& visitor);
  /// Rules that involve several settings: a friction between −1 and 0, lengths that do not fit the cells or
  /// what the ground repeats after. Throws SettingError.
  void validate() const;

  /// Whether all settings are at their defaults.
  bool is_default() const;
  /// Whether it is uneven.
  bool has_field() const { return kind != "plane"; }
  /// Kind::concentric of its kind.
  bool concentric() const;
  /// `gravity_m_s2` (x and y 0, z negative) as seen from the plane of the ground, which stays z = 0: on a
  /// slope the world's z axis is the plane's normal. Its magnitude is kept.
  Vec3 tilted(Vec3 gravity_m_s2) const;
};

}  // namespace amble::ground
