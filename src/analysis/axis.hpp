#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "amble/analysis/svg.hpp"

namespace amble::analysis {

/// A closed interval of data.
struct Interval {
  double lower = 0.0, upper = 1.0;

  double length() const { return upper - lower; }
};

/// The smallest interval with `a` and with `value`.
Interval including(Interval a, double value);

/// Where an axis is marked.
struct Ticks {
  std::vector<double> values;  ///< ascending, all inside the interval asked for
  double step = 1.0;           ///< between neighbours: 1, 2 or 5 × 10^k
  int decimals = 0;            ///< how many the labels need
};

/// All multiples of 1, 2 or 5 × 10^k inside the interval, with the smallest such step that gives no more than
/// `most` of them (`most` is at least 2). No step is finer than `finest_step`: 1 for things that are counted.
/// An interval without length has one tick.
Ticks nice_ticks(Interval interval, int most, double finest_step = 0.0);

/// A number for people: fixed decimals and a true minus sign.
std::string label(double value, int decimals);

/// Linear map from data to px.
struct Scale {
  Interval data;
  double lower_px = 0.0, upper_px = 0.0;

  double operator()(double value) const {
    return lower_px + (value - data.lower) / data.length() * (upper_px - lower_px);
  }
};

/// Horizontal hair lines from `left_px` to `right_px` with their labels to the left; the topmost label
/// carries the unit.
void draw_y_axis(Svg& svg, const Scale& y, const Ticks& ticks, double left_px, double right_px,
                 std::string_view unit);

/// A base line with labels below; the last label carries the unit.
void draw_x_axis(Svg& svg, const Scale& x, const Ticks& ticks, double base_px, std::string_view unit);

/// Moves labels apart that would overlap: positions in px, to stand at least `gap_px` from each other, each
/// as near to where it was as keeping the order allows.
void spread(std::vector<double>& positions_px, double gap_px);

}  // namespace amble::analysis
