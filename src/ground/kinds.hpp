#pragma once

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "amble/core/random.hpp"
#include "amble/ground/settings.hpp"
#include "amble/io/own_settings.hpp"

namespace amble::ground {

/// Height over the plane, in units of Settings::height_m, by place: x and y from −half a period to half a
/// period, after which the ground repeats.
using Shape = std::function<double(double x_m, double y_m)>;

/// 6 t⁵ − 15 t⁴ + 10 t³ (Perlin 2002): from 0 to 1, level at both ends.
constexpr double smooth(double t) {
  return t * t * t * (t * (6.0 * t - 15.0) + 10.0);
}

/// A kind of ground that configs can choose.
struct Kind {
  std::string name;  ///< value of ground.kind: a–z, 0–9, "-" and "_"
  /// `period_m`: after so much the ground repeats, in both directions. `stream` has the random numbers of
  /// this field; `settings.own` has all of `numbers`. Finite everywhere. The same on every CPU, to the bit:
  /// so without sin, exp and the like of the C library, and without the standard library's random numbers.
  /// Empty: the plane.
  std::function<Shape(const Settings& settings, double period_m, Stream stream)> shape;
  /// Whether heights follow from the distance to the flat start alone, which then belongs to the shape.
  /// Others are blended into it.
  bool concentric = false;
  std::vector<io::OwnNumber> numbers = {};  ///< its settings: [ground.own]
};

/// Adds a kind, from then on one of those that configs can choose. Before the first config is read; not
/// thread safe. Throws UserError for a name that is taken or cannot be one. AMBLE_CHECK: it has a shape.
void register_ground(Kind kind);

/// By its name. AMBLE_CHECK: it is known, as Settings::describe() ensures.
const Kind& kind_of(const Settings& settings);

/// In the order in which they are listed to users: the plane, amble's others, those that were added.
const std::deque<Kind>& kinds();

}  // namespace amble::ground
