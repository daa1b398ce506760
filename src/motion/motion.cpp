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

std::vector<Vec3> commanded_path_m(const robot::RobotSpec& robot, const Motion& motion) {
  std::vector<Vec3> path_m;
  if (motion.command.empty()) return path_m;
  const Quat turn = motion.root_rotation.front() * conjugate(robot.bodies[0].rotation);
  const Vec3 forward = rotate(turn, {1.0, 0.0, 0.0});
  double heading_rad = std::atan2(forward.y, forward.x);
  path_m.push_back(motion.com_start_m);
  for (const auto& [speed_m_s, turn_rad_s] : motion.command) {
    const double way_m = static_cast<double>(speed_m_s) * motion.frame_s;
    const Vec3 at_m = path_m.back();
    path_m.push_back(
        {at_m.x + way_m * std::cos(heading_rad), at_m.y + way_m * std::sin(heading_rad), at_m.z});
    heading_rad += static_cast<double>(turn_rad_s) * motion.frame_s;
  }
  return path_m;
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
