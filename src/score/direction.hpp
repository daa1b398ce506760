#pragma once

#include "amble/record/trajectory.hpp"

namespace amble::score {

/// A direction over the ground, of unit length.
struct Direction {
  double x = 1.0, y = 0.0;
};

inline double along(Direction direction, double x_m, double y_m) {
  return x_m * direction.x + y_m * direction.y;
}

/// Cosine and sine of an angle, degrees; exact for multiples of 90. The same on every CPU.
Direction unit_direction(double angle_deg);
/// The robot's forward axis at the start, turned counter-clockwise.
Direction turned(const record::Trajectory& trajectory, double angle_deg);
/// Angle of a direction to the x axis, −180 … 180 degrees. The same on every CPU.
double angle_deg(Direction direction);

}  // namespace amble::score
