#include "amble/analysis/kinematics.hpp"

#include <cmath>

#include "amble/core/check.hpp"

namespace amble::analysis {

std::vector<BodyPose> body_poses(const RobotModel& robot, const BodyPose& root,
                                 std::span<const double> angles_rad) {
  AMBLE_CHECK(angles_rad.size() == robot.joints.size(), "one angle per joint");
  std::vector<BodyPose> poses;
  poses.push_back(root);
  for (std::size_t b = 1; b < robot.bodies.size(); ++b) {
    const Body& body = robot.bodies[b];
    const BodyPose& parent = poses[static_cast<std::size_t>(body.parent)];
    BodyPose pose{parent.position_m + rotate(parent.rotation, body.position_m),
                  parent.rotation * body.rotation};
    // Each hinge turns the body about its anchor, which stays where it is; later hinges are carried along by
    // earlier ones.
    for (const int j : robot.joints_of_body(static_cast<int>(b))) {
      const Joint& joint = robot.joints[static_cast<std::size_t>(j)];
      const Vec3 anchor_m = pose.position_m + rotate(pose.rotation, joint.anchor_m);
      pose.rotation = pose.rotation * axis_angle(joint.axis, angles_rad[static_cast<std::size_t>(j)]);
      pose.position_m = anchor_m - rotate(pose.rotation, joint.anchor_m);
    }
    poses.push_back(pose);
  }
  return poses;
}

std::vector<BodyPose> body_poses(const RobotModel& robot, const Motion& motion, int frame) {
  const auto k = static_cast<std::size_t>(frame);
  std::vector<double> angles_rad;
  for (const auto& angle : motion.angle_rad) angles_rad.push_back(angle[k]);
  return body_poses(robot, {motion.root_m[k], motion.root_rotation[k]}, angles_rad);
}

Vec3 geom_centre_m(const Geom& geom, const std::vector<BodyPose>& poses) {
  const BodyPose& pose = poses[static_cast<std::size_t>(geom.body)];
  return pose.position_m + rotate(pose.rotation, geom.position_m);
}

double geom_bottom_m(const Geom& geom, const std::vector<BodyPose>& poses) {
  const double centre_m = geom_centre_m(geom, poses).z;
  // What the world's up is in the geom's own axes.
  const Quat rotation = poses[static_cast<std::size_t>(geom.body)].rotation * geom.rotation;
  const Vec3 up = rotate(conjugate(rotation), {0.0, 0.0, 1.0});
  const Vec3 size = geom.size_m;
  switch (geom.shape) {
    case Shape::sphere:
      return centre_m - size.x;
    case Shape::capsule:
      return centre_m - size.x - size.y * std::abs(up.z);
    case Shape::cylinder:
      return centre_m - size.x * std::hypot(up.x, up.y) - size.y * std::abs(up.z);
    case Shape::box:
      return centre_m - size.x * std::abs(up.x) - size.y * std::abs(up.y) - size.z * std::abs(up.z);
  }
  return centre_m;
}

}  // namespace amble::analysis
