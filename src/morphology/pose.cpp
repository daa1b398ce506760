#include "amble/morphology/pose.hpp"

#include <algorithm>
#include <cmath>

namespace amble::morphology {

std::vector<Pose> start_poses(const RobotSpec& robot) {
  std::vector<Pose> poses;
  poses.reserve(robot.bodies.size());
  for (const Body& body : robot.bodies) {
    const Pose own{body.position_m, body.rotation};
    poses.push_back(body.parent < 0 ? own : poses[static_cast<std::size_t>(body.parent)] * own);
  }
  return poses;
}

double start_clearance_m(const RobotSpec& robot, int geom) {
  const Geom& shape = robot.geoms[static_cast<std::size_t>(geom)];
  const Pose body = start_poses(robot)[static_cast<std::size_t>(shape.body)];
  const Pose pose = body * Pose{shape.position_m, shape.rotation};

  // How far the shape reaches below its centre: the world's z seen from the geom's own axes decides.
  const Vec3 up = rotate(conjugate(pose.rotation), {0.0, 0.0, 1.0});
  const Vec3 size = shape.size_m;
  double reach = 0.0;
  switch (shape.shape) {
    case Shape::sphere:
      reach = size.x;
      break;
    case Shape::capsule:
      reach = size.x + size.y * std::abs(up.z);
      break;
    case Shape::cylinder:
      reach = size.x * std::sqrt(std::max(0.0, 1.0 - up.z * up.z)) + size.y * std::abs(up.z);
      break;
    case Shape::box:
      reach = size.x * std::abs(up.x) + size.y * std::abs(up.y) + size.z * std::abs(up.z);
      break;
  }
  return pose.position_m.z - reach;
}

}  // namespace amble::morphology
