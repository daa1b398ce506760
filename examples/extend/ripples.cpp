// A ground and a quantity of one's own: ripples to walk over, and how straight a walk went, for scores,
// limits and maps.
// Use:
//   amble --plugin build/extend/libripples.so evolve examples/extend/ripples.toml --out runs/ripples
#include <algorithm>
#include <cmath>

#include "amble/core/plugin.hpp"
#include "amble/ground/kinds.hpp"
#include "amble/score/score.hpp"

namespace {

using namespace amble;

/// A parabola over each half wave, up and down: sin() has other last bits on other processors.
ground::Shape ripples(const ground::Settings& settings, double period_m, const Stream&) {
  // A whole number of waves, as the ground repeats after a period.
  const double waves = std::max(1.0, std::round(period_m / settings.own.numbers.at("wavelength_m")));
  return [=](double x_m, double) {
    const double at = waves * (x_m / period_m + 0.5), half = 2.0 * (at - std::floor(at));
    const double t = half < 1.0 ? half : half - 1.0, height = 2.0 * t * (1.0 - t);
    return half < 1.0 ? height : -height;
  };
}

/// The distance from start to end as a share of the way from second to second; 1 for a straight line.
double straightness(const record::Trajectory& trajectory, const score::Context&) {
  const std::vector<double>& at_m = trajectory.com_by_second_m;  // x0, y0, x1, y1, …
  double way_m = 0.0, x_m = 0.0, y_m = 0.0;
  for (std::size_t i = 0; i + 1 < at_m.size(); i += 2) {
    const double dx_m = at_m[i] - x_m, dy_m = at_m[i + 1] - y_m;
    way_m += std::sqrt(dx_m * dx_m + dy_m * dy_m);
    x_m = at_m[i];
    y_m = at_m[i + 1];
  }
  return way_m > 0.0 ? std::min(1.0, std::sqrt(x_m * x_m + y_m * y_m) / way_m) : 0.0;
}

}  // namespace

AMBLE_PLUGIN {
  amble::ground::register_ground({.name = "ripples",
                                  .shape = ripples,
                                  .numbers = {{.name = "wavelength_m",
                                               .value = 0.5,
                                               .range = {0.05, 10.0},
                                               .what = "from one ripple to the next, m"}}});
  amble::score::register_quantity({.name = "straightness",
                                   .unit = "",
                                   .range = {0.0, 1.0},
                                   .measures = {.seconds = true},
                                   .of = straightness});
}
