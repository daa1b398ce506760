#include "amble/figures/axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "amble/core/check.hpp"

namespace amble::figures {
namespace {

// Tolerance for rounding when a bound is itself a multiple of the step.
constexpr double slack = 1e-9;

}  // namespace

Interval including(Interval a, double value) {
  return {std::min(a.lower, value), std::max(a.upper, value)};
}

Ticks nice_ticks(Interval interval, int most, double finest_step) {
  AMBLE_CHECK(most >= 2 && std::isfinite(interval.lower) && std::isfinite(interval.upper),
              "an axis has bounds");
  if (!(interval.length() > 0.0)) return {{interval.lower}, 1.0, 0};
  // `most` ticks span at most most + 1 steps, so no step below this is large enough.
  const double least = std::max(interval.length() / (most + 1), finest_step);
  for (double power = std::pow(10.0, std::floor(std::log10(least) + slack));; power *= 10.0)
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double step = factor * power;
      const double first = std::ceil(interval.lower / step - slack);
      const double last = std::floor(interval.upper / step + slack);
      if (last - first + 1.0 > most || step < finest_step * (1.0 - slack)) continue;
      Ticks ticks{{}, step, std::max(0, static_cast<int>(-std::floor(std::log10(step) + slack)))};
      for (double k = first; k <= last; ++k) ticks.values.push_back(k * step);
      return ticks;
    }
}

std::string label(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (!text.starts_with('-')) return text;
  const bool rounds_to_zero = text.find_first_of("123456789") == std::string::npos;
  return (rounds_to_zero ? "" : "\u2212") + text.substr(1);
}

void draw_y_axis(Svg& svg, const Scale& y, const Ticks& ticks, double left_px, double right_px,
                 std::string_view unit) {
  for (std::size_t i = 0; i < ticks.values.size(); ++i) {
    const double at = y(ticks.values[i]);
    svg.line({left_px, at}, {right_px, at}, "grid");
    const bool last = i + 1 == ticks.values.size();
    svg.text({left_px - 8, at + 4}, Anchor::end, "tick",
             label(ticks.values[i], ticks.decimals) + (last ? std::string(unit) : ""));
  }
}

void draw_x_axis(Svg& svg, const Scale& x, const Ticks& ticks, double base_px, std::string_view unit) {
  svg.line({x.lower_px, base_px}, {x.upper_px, base_px}, "axis");
  for (std::size_t i = 0; i < ticks.values.size(); ++i) {
    const double at = x(ticks.values[i]);
    svg.line({at, base_px}, {at, base_px + 5}, "axis");
    const bool origin = ticks.values[i] == 0.0, last = i + 1 == ticks.values.size();
    svg.text({at, base_px + 19}, Anchor::middle, "tick",
             label(ticks.values[i], origin ? 0 : ticks.decimals) + (last ? std::string(unit) : ""));
  }
}

void spread(std::vector<double>& positions_px, double gap_px) {
  std::vector<std::size_t> order(positions_px.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return positions_px[a] < positions_px[b]; });
  // Neighbours that are too close share the missing distance; chains of them converge within a few rounds.
  for (std::size_t round = 0; round < 20 * order.size(); ++round)
    for (std::size_t i = 1; i < order.size(); ++i) {
      double& above = positions_px[order[i - 1]];
      double& below = positions_px[order[i]];
      const double missing = gap_px - (below - above);
      if (missing <= 0.0) continue;
      above -= 0.5 * missing;
      below += 0.5 * missing;
    }
}

}  // namespace amble::figures
