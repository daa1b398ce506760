#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "amble/figures/svg.hpp"

namespace amble::figures {

/// A closed interval of data.
struct Interval {
  double lower = 0.0, upper = 1.0;

  double length() const { return upper - lower; }
};

/// The smallest interval that contains `a` and `value`.
Interval including(Interval a, double value);

/// The tick marks of an axis.
struct Ticks {
  std::vector<double> values;  ///< ascending, all inside the interval
  double step = 1.0;           ///< between neighbours: 1, 2 or 5 × 10^k
  int decimals = 0;            ///< of the labels
};

/// All multiples of 1, 2 or 5 × 10^k inside the interval, with the smallest such step that gives no more than
/// `most` of them (at least 2). The step is not smaller than `finest_step`: 1 for counts. An interval without
/// length has one tick.
Ticks nice_ticks(Interval interval, int most, double finest_step = 0.0);

/// A number as text for readers: fixed decimals and a true minus sign (U+2212).
std::string label(double value, int decimals);

/// Linear map from data to px.
struct Scale {
  Interval data;
  double lower_px = 0.0, upper_px = 0.0;

  double operator()(double value) const {
    return lower_px + (value - data.lower) / data.length() * (upper_px - lower_px);
  }
};

/// Horizontal grid lines from `left_px` to `right_px` with their labels to the left; the topmost label
/// carries the unit.
void draw_y_axis(Svg& svg, const Scale& y, const Ticks& ticks, double left_px, double right_px,
                 std::string_view unit);

/// A base line with labels below; the last label carries the unit.
void draw_x_axis(Svg& svg, const Scale& x, const Ticks& ticks, double base_px, std::string_view unit);

/// Moves overlapping labels apart: positions in px, afterwards at least `gap_px` from each other, in the same
/// order, each as near to its old position as possible.
void spread(std::vector<double>& positions_px, double gap_px);

}  // namespace amble::figures
