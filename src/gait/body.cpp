#include "amble/gait/body.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "amble/core/index.hpp"
#include "amble/robot/legs.hpp"
#include "amble/robot/pose.hpp"

namespace amble::gait {
namespace {

/// If the feet are above the ground in the start pose, that clearance is subtracted.
double leg_length_m(const robot::RobotSpec& robot, const std::vector<robot::Pose>& poses) {
  double clearance_m = std::numeric_limits<double>::infinity();
  for (const robot::Leg& leg : robot.legs)
    clearance_m = std::min(clearance_m, robot::foot_bottom_m(robot, leg, poses));
  double sum_m = 0.0;
  int count = 0;
  const std::vector<Vec3> hips_m = robot::hips_m(robot, poses);
  for (std::size_t leg = 0; leg < hips_m.size(); ++leg) {
    if (robot::hip_joint(robot, robot.legs[leg]) < 0) continue;
    sum_m += hips_m[leg].z;
    ++count;
  }
  return count == 0 ? 0.0 : sum_m / count - std::max(clearance_m, 0.0);
}

std::optional<QuadrupedLegs> quadruped_legs(const std::vector<Vec3>& feet) {
  if (feet.size() != 4) return std::nullopt;
  std::array<int, 4> order{0, 1, 2, 3};
  std::ranges::stable_sort(order, [&](int a, int b) { return feet[to_index(a)].x > feet[to_index(b)].x; });
  if (feet[to_index(order[1])].x <= feet[to_index(order[2])].x) return std::nullopt;
  for (const std::size_t left : {std::size_t{0}, std::size_t{2}}) {
    if (feet[to_index(order[left])].y < feet[to_index(order[left + 1])].y)
      std::swap(order[left], order[left + 1]);
    if (feet[to_index(order[left])].y <= feet[to_index(order[left + 1])].y) return std::nullopt;
  }
  return QuadrupedLegs{order[0], order[1], order[2], order[3]};
}

}  // namespace

Body body_of(const robot::RobotSpec& robot) {
  const std::vector<robot::Pose> poses = robot::start_poses(robot);
  Body body;
  body.robot = robot.name;
  for (const robot::Leg& leg : robot.legs) body.legs.push_back(leg.name);
  for (const robot::Joint& joint : robot.joints) body.joints.push_back(joint.name);
  body.mass_kg = robot.total_mass_kg();
  body.gravity_m_s2 = norm(robot.gravity_m_s2);
  body.leg_length_m = leg_length_m(robot, poses);
  body.com_start_m = robot::start_com_m(robot);
  const std::vector<Vec3> feet_m = robot::feet_m(robot, poses);
  body.quadruped = quadruped_legs(feet_m);
  if (feet_m.size() == 2 || feet_m.size() == 6) body.pairs = robot::leg_pairs(feet_m);
  return body;
}

}  // namespace amble::gait
