#include "amble/morphology/rounding.hpp"

#include <cmath>

namespace amble::morphology {

double inward(double value, double start) {
  const double scaled = value * 1e4;
  return (value < start ? std::ceil(scaled - 1e-6) : std::floor(scaled + 1e-6)) / 1e4;
}

double rounded_down(double length_m) {
  double steps_per_m = 1e3;
  while (length_m > 0.0 && length_m * steps_per_m < 10.0 && steps_per_m < 1e12) steps_per_m *= 10.0;
  return std::floor(steps_per_m * length_m) / steps_per_m;
}

double rounded_up(double length_m) {
  double steps_per_m = 1e4;
  while (length_m > 0.0 && length_m * steps_per_m < 10.0 && steps_per_m < 1e12) steps_per_m *= 10.0;
  return std::ceil(length_m * steps_per_m - 1e-6) / steps_per_m;
}

}  // namespace amble::morphology
