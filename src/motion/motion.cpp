#include "amble/motion/motion.hpp"

#include <algorithm>
#include <cmath>

namespace amble::motion {

std::vector<robot::Pose> body_poses(const robot::RobotSpec& robot, const Motion& motion, int frame) {
  const auto k = static_cast<std::size_t>(frame);
  std::vector<double> angles_rad;
  angles_rad.reserve(motion.angle_rad.size());
  for (const auto& angle : motion.angle_rad) angles_rad.push_back(static_cast<double>(angle[k]));
  return robot::poses_at(robot, {motion.root_m[k], motion.root_rotation[k]}, angles_rad);
}

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

}  // namespace amble::motion
