#pragma once

#include <cmath>

namespace amble {

/// A range whose ends are the same value, as of an angle or of a phase; by default a line.
struct Circle {
  double lowest = 0.0,  ///< one of these ends
      turn = 0.0;       ///< how much more the other one is, > 0; 0: they differ

  /// The same value, by whole turns, that is nearest to `other`.
  double nearest(double value, double other) const {
    return turn > 0.0 ? value - turn * std::round((value - other) / turn) : value;
  }
  /// The same value within the range, if it is at most a turn outside it.
  double inside(double value) const {
    if (turn <= 0.0 || (value >= lowest && value <= lowest + turn)) return value;
    return value < lowest ? value + turn : value - turn;
  }
};

}  // namespace amble
