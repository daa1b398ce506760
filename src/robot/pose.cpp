#include "amble/robot/pose.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"

namespace amble::robot {

std::vector<Pose> start_poses(const RobotSpec& robot) {
  std::vector<Pose> poses;
  poses.reserve(robot.bodies.size());
  for (const Body& body : robot.bodies) {
    const Pose own{body.position_m, body.rotation};
    poses.push_back(body.parent < 0 ? own : poses[to_index(body.parent)] * own);
  }
  return poses;
}

Pose pose_along(const RobotSpec& robot, int body, const Pose& parent, std::span<const double> angles_rad,
                std::size_t hinges) {
  const Body& its = robot.bodies[to_index(body)];
  Pose pose = parent * Pose{its.position_m, its.rotation};
  const std::vector<int> chain = robot.joints_of_body(body);
  for (std::size_t i = 0; i < std::min(hinges, chain.size()); ++i) {
    const Joint& joint = robot.joints[to_index(chain[i])];
    const Quat turn = axis_angle(joint.axis, angles_rad[to_index(chain[i])]);
    // About the anchor, which stays where it is.
    pose = pose * Pose{joint.anchor_m - rotate(turn, joint.anchor_m), turn};
  }
  return pose;
}

std::vector<Pose> poses_at(const RobotSpec& robot, const Pose& root, std::span<const double> angles_rad) {
  AMBLE_CHECK(angles_rad.size() == robot.joints.size(), "one angle per joint");
  std::vector<Pose> poses{root};
  poses.reserve(robot.bodies.size());
  for (int b = 1; b < static_cast<int>(robot.bodies.size()); ++b) {
    const Pose& parent = poses[to_index(robot.bodies[to_index(b)].parent)];
    poses.push_back(pose_along(robot, b, parent, angles_rad, robot.joints.size()));
  }
  return poses;
}

bool starts_elsewhere(Vec3 com_m, Vec3 start_com_m) {
  constexpr double rounding_m = 1e-5;
  return !(norm(com_m - start_com_m) <= rounding_m);
}

Vec3 start_com_m(const RobotSpec& robot) {
  const std::vector<Pose> poses = start_poses(robot);
  Vec3 moment;
  for (std::size_t b = 0; b < robot.bodies.size(); ++b)
    moment = moment + robot.bodies[b].mass_kg * (poses[b] * robot.bodies[b].com_m);
  return (1.0 / robot.total_mass_kg()) * moment;
}

Vec3 centre_m(const Geom& geom, std::span<const Pose> poses) {
  return poses[to_index(geom.body)] * geom.position_m;
}

double bottom_m(const Geom& geom, std::span<const Pose> poses) {
  const Pose pose = poses[to_index(geom.body)] * Pose{geom.position_m, geom.rotation};

  // How far the shape reaches below its centre: the world's z seen from the geom's own axes decides.
  const Vec3 up = rotate(conjugate(pose.rotation), {0.0, 0.0, 1.0});
  const Vec3 size = geom.size_m;
  double reach = 0.0;
  switch (geom.shape) {
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
    case Shape::mesh:
      reach = -norm(size);
      for (const Vec3 vertex : geom.vertices_m) reach = std::max(reach, -dot(up, vertex));
      break;
  }
  return pose.position_m.z - reach;
}

double start_clearance_m(const RobotSpec& robot, int geom) {
  return bottom_m(robot.geoms[to_index(geom)], start_poses(robot));
}

double clearance_m(const RobotSpec& robot, std::span<const Pose> poses) {
  double lowest_m = std::numeric_limits<double>::infinity();
  for (const Geom& geom : robot.geoms)
    if (geom.collides) lowest_m = std::min(lowest_m, bottom_m(geom, poses));
  return lowest_m;
}

}  // namespace amble::robot
