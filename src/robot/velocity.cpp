#include "amble/robot/velocity.hpp"

#include <algorithm>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"

namespace amble::robot {

Twist twist_along(const RobotSpec& robot, int body, const Pose& parent, const Twist& parent_twist,
                  const JointStates& joints, std::size_t hinges) {
  const std::vector<int> chain = robot.joints_of_body(body);
  const std::size_t count = std::min(hinges, chain.size());
  const Pose pose = pose_along(robot, body, parent, joints.angle_rad, count);
  Twist twist{parent_twist.of_point(pose.position_m - parent.position_m),
              parent_twist.angular_velocity_rad_s};
  for (std::size_t i = 0; i < count; ++i) {
    // Its own turn leaves a hinge's axis and anchor where they are.
    const Joint& joint = robot.joints[to_index(chain[i])];
    const Pose at = pose_along(robot, body, parent, joints.angle_rad, i + 1);
    const Vec3 turn_rad_s = joints.speed_rad_s[to_index(chain[i])] * rotate(at.rotation, joint.axis);
    twist.angular_velocity_rad_s = twist.angular_velocity_rad_s + turn_rad_s;
    twist.velocity_m_s = twist.velocity_m_s + cross(turn_rad_s, pose.position_m - at * joint.anchor_m);
  }
  return twist;
}

std::vector<Twist> twists_at(const RobotSpec& robot, std::span<const Pose> poses, const Twist& root,
                             const JointStates& joints) {
  AMBLE_CHECK(joints.angle_rad.size() == robot.joints.size() &&
                  joints.speed_rad_s.size() == robot.joints.size() && poses.size() == robot.bodies.size(),
              "one angle and speed per joint, one pose per body");
  std::vector<Twist> twists{root};
  twists.reserve(robot.bodies.size());
  for (int b = 1; b < static_cast<int>(robot.bodies.size()); ++b) {
    const std::size_t parent = to_index(robot.bodies[to_index(b)].parent);
    twists.push_back(twist_along(robot, b, poses[parent], twists[parent], joints, robot.joints.size()));
  }
  return twists;
}

WholeMotion whole_motion(const RobotSpec& robot, std::span<const Pose> poses, std::span<const Twist> twists) {
  WholeMotion whole;
  const double share = 1.0 / robot.total_mass_kg();
  const auto velocity = [&](std::size_t b) {
    return twists[b].of_point(rotate(poses[b].rotation, robot.bodies[b].com_m));
  };
  for (std::size_t b = 0; b < robot.bodies.size(); ++b) {
    const Body& body = robot.bodies[b];
    whole.com_m = whole.com_m + share * body.mass_kg * (poses[b] * body.com_m);
    whole.com_velocity_m_s = whole.com_velocity_m_s + share * body.mass_kg * velocity(b);
  }
  // L = Σ m r × v + I ω, with I diagonal in the principal axes.
  for (std::size_t b = 0; b < robot.bodies.size(); ++b) {
    const Body& body = robot.bodies[b];
    const Quat principal = poses[b].rotation * body.inertia_rotation;
    const Vec3 spin = rotate(conjugate(principal), twists[b].angular_velocity_rad_s);
    const Vec3 moments = body.inertia_kg_m2;
    whole.angular_momentum_kg_m2_s =
        whole.angular_momentum_kg_m2_s +
        body.mass_kg * cross(poses[b] * body.com_m - whole.com_m, velocity(b)) +
        rotate(principal, {moments.x * spin.x, moments.y * spin.y, moments.z * spin.z});
  }
  return whole;
}

}  // namespace amble::robot
