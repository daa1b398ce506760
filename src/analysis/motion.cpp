#include "amble/analysis/motion.hpp"

namespace amble::analysis {

std::vector<robot::Pose> body_poses(const robot::RobotSpec& robot, const Motion& motion, int frame) {
  const auto k = static_cast<std::size_t>(frame);
  std::vector<double> angles_rad;
  angles_rad.reserve(motion.angle_rad.size());
  for (const auto& angle : motion.angle_rad) angles_rad.push_back(static_cast<double>(angle[k]));
  return robot::poses_at(robot, {motion.root_m[k], motion.root_rotation[k]}, angles_rad);
}

}  // namespace amble::analysis
