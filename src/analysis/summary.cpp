#include "amble/analysis/summary.hpp"

#include <algorithm>
#include <cmath>

namespace amble::analysis {

Summary summarise(const Motion& motion) {
  Summary summary;
  summary.outcome = motion.outcome;
  summary.seconds = motion.seconds();
  if (motion.frames() > 0) {
    const Vec3 moved = motion.com_m.back() - motion.com_start_m;
    summary.distance_m = std::hypot(moved.x, moved.y);
    summary.mean_speed_m_s = summary.distance_m / summary.seconds;
  }
  for (const auto& trigger : motion.trigger)
    summary.triggers.push_back(static_cast<int>(std::ranges::count(trigger, true)));
  return summary;
}

}  // namespace amble::analysis
