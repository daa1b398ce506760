#include "amble/physics/batch/motion.hpp"

#include "amble/robot/pose.hpp"
#include "amble/robot/velocity.hpp"

namespace amble::physics::batch {
namespace {

robot::WholeMotion whole_motion(const robot::RobotSpec& robot, const RootPose& root,
                                const robot::Twist& twist, const robot::JointStates& joints) {
  const auto poses = robot::poses_at(robot, {root.position_m, root.rotation}, joints.angle_rad);
  return robot::whole_motion(robot, poses, robot::twists_at(robot, poses, twist, joints));
}

/// Solves x a + y b + z c = v by Cramer's rule.
Vec3 solve(Vec3 a, Vec3 b, Vec3 c, Vec3 v) {
  const double scale = 1.0 / dot(a, cross(b, c));
  return {scale * dot(v, cross(b, c)), scale * dot(a, cross(v, c)), scale * dot(a, cross(b, v))};
}

}  // namespace

MovingPose motion_of(const robot::RobotSpec& robot, const RootPose& root, const RobotState& state) {
  const std::vector<double> still(state.speed_rad_s.size(), 0.0);
  // L and v_com are linear in the root's twist and the joints' speeds; L does not depend on the root's
  // velocity, so L − L(speeds) = I ω first, then what is left of v_com.
  const auto turning = [&](Vec3 spin) {
    return whole_motion(robot, root, {{}, spin}, {state.angle_rad, still}).angular_momentum_kg_m2_s;
  };
  const robot::JointStates joints{state.angle_rad, state.speed_rad_s};
  const Vec3 of_joints = whole_motion(robot, root, {}, joints).angular_momentum_kg_m2_s;
  const Vec3 spin = solve(turning({1.0, 0.0, 0.0}), turning({0.0, 1.0, 0.0}), turning({0.0, 0.0, 1.0}),
                          state.angular_momentum_kg_m2_s - of_joints);
  const robot::WholeMotion about_root = whole_motion(robot, root, {{}, spin}, joints);
  return {.pose = {root, state.angle_rad},
          .velocity_m_s = state.velocity_m_s - about_root.com_velocity_m_s,
          .angular_velocity_rad_s = spin,
          .joint_speed_rad_s = state.speed_rad_s};
}

void set_velocities(const robot::RobotSpec& robot, const MovingPose& motion, RobotState& state) {
  const robot::WholeMotion whole =
      whole_motion(robot, motion.pose.root, {motion.velocity_m_s, motion.angular_velocity_rad_s},
                   {motion.pose.joint_angle_rad, motion.joint_speed_rad_s});
  state.velocity_m_s = whole.com_velocity_m_s;
  state.angular_momentum_kg_m2_s = whole.angular_momentum_kg_m2_s;
  state.speed_rad_s = motion.joint_speed_rad_s;
}

}  // namespace amble::physics::batch
