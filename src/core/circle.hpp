#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

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

/// Between two points, each dimension of which a full turn is given being a circle of that length: along its
/// chord, so that the points lie in a Euclidean space and kernels of their distances are positive definite.
/// Never longer than squared_distance(), and nearly as long when near. `turns`: as there.
inline double squared_chord(std::span<const double> a, std::span<const double> b,
                            std::span<const double> turns) {
  double squared = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    double difference = a[i] - b[i];
    if (!turns.empty() && turns[i] > 0.0) {
      const double radius = turns[i] / (2.0 * std::numbers::pi);
      difference = 2.0 * radius * std::sin(0.5 * difference / radius);
    }
    squared += difference * difference;
  }
  return squared;
}

/// Between two points, the short way round in dimensions of which a full turn is given. `turns`: of each
/// dimension, 0 of a line; empty: all are lines.
inline double squared_distance(std::span<const double> a, std::span<const double> b,
                               std::span<const double> turns) {
  double squared = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    double difference = a[i] - b[i];
    if (!turns.empty() && turns[i] > 0.0) difference = std::remainder(difference, turns[i]);
    squared += difference * difference;
  }
  return squared;
}

}  // namespace amble
