#include "amble/score/distance.hpp"

#include <cmath>

namespace amble::score {

double distance_m(const record::Trajectory& trajectory) {
  if (trajectory.outcome == record::Outcome::diverged) return 0.0;
  const Vec3 moved = trajectory.com_end_m - trajectory.com_start_m;
  return std::sqrt(moved.x * moved.x + moved.y * moved.y);
}

double credited_m(double distance_m, record::Outcome outcome, double fall_factor) {
  return outcome == record::Outcome::fell ? fall_factor * distance_m : distance_m;
}

}  // namespace amble::score
