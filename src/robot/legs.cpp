#include "amble/robot/legs.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "amble/core/index.hpp"

namespace amble::robot {
namespace {

/// Differences up to this are rounding: a model's numbers and rotations have fewer digits than doubles.
constexpr double same_place_m = 1e-6;

}  // namespace

int hip_joint(const RobotSpec& robot, const Leg& leg) {
  // Bodies precede their children, and the joints of one body are in the order of the chain.
  const auto depth = [&](int j) {
    const Joint& joint = robot.joints[to_index(j)];
    return std::pair(joint.body, joint.chain_index);
  };
  int first = -1;
  for (const int joint : leg.joints)
    if (joint >= 0 && (first < 0 || depth(joint) < depth(first))) first = joint;
  return first;
}

std::vector<Vec3> hips_m(const RobotSpec& robot, std::span<const Pose> poses) {
  std::vector<Vec3> places_m = feet_m(robot, poses);
  for (std::size_t leg = 0; leg < places_m.size(); ++leg) {
    const int hip = hip_joint(robot, robot.legs[leg]);
    if (hip < 0) continue;
    const Joint& joint = robot.joints[to_index(hip)];
    places_m[leg] = poses[to_index(joint.body)] * joint.anchor_m;
  }
  return places_m;
}

Vec3 foot_m(const RobotSpec& robot, const Leg& leg, std::span<const Pose> poses) {
  Vec3 sum = centre_m(robot.geoms[to_index(leg.foot_geoms.front())], poses);
  if (leg.foot_geoms.size() == 1) return sum;
  for (const int geom : std::span(leg.foot_geoms).subspan(1))
    sum = sum + centre_m(robot.geoms[to_index(geom)], poses);
  return (1.0 / static_cast<double>(leg.foot_geoms.size())) * sum;
}

double foot_bottom_m(const RobotSpec& robot, const Leg& leg, std::span<const Pose> poses) {
  double lowest_m = std::numeric_limits<double>::infinity();
  for (const int geom : leg.foot_geoms)
    lowest_m = std::min(lowest_m, bottom_m(robot.geoms[to_index(geom)], poses));
  return lowest_m;
}

std::vector<Vec3> feet_m(const RobotSpec& robot, std::span<const Pose> poses) {
  std::vector<Vec3> places_m;
  for (const Leg& leg : robot.legs) places_m.push_back(foot_m(robot, leg, poses));
  return places_m;
}

double leg_length_m(const RobotSpec& robot, const Leg& leg, std::span<const Pose> poses) {
  Vec3 end = foot_m(robot, leg, poses);
  double length_m = 0.0;
  // From the foot up the chain, joint by joint.
  for (int body = robot.foot_body(leg); body > 0; body = robot.bodies[to_index(body)].parent)
    for (const int j : robot.joints_of_body(body)) {
      if (std::ranges::find(leg.joints, j) == leg.joints.end()) continue;
      const Vec3 anchor = poses[to_index(body)] * robot.joints[to_index(j)].anchor_m;
      length_m += norm(end - anchor);
      end = anchor;
    }
  return length_m;
}

double longest_leg_m(const RobotSpec& robot) {
  const std::vector<Pose> poses = start_poses(robot);
  double longest_m = 0.0;
  for (const Leg& leg : robot.legs) longest_m = std::max(longest_m, leg_length_m(robot, leg, poses));
  return longest_m;
}

double leg_height_m(const RobotSpec& robot) {
  if (robot.legs.empty()) return 0.0;
  const std::vector<Pose> poses = start_poses(robot);
  const std::vector<Vec3> hips = hips_m(robot, poses);
  double sum_m = 0.0;
  for (std::size_t l = 0; l < robot.legs.size(); ++l)
    sum_m += hips[l].z - foot_bottom_m(robot, robot.legs[l], poses);
  return sum_m / static_cast<double>(robot.legs.size());
}

std::vector<LegPair> leg_pairs(std::span<const Vec3> places_m) {
  const std::size_t half = places_m.size() / 2;
  if (half == 0 || places_m.size() % 2 != 0) return {};
  const auto place = [&](int leg) { return places_m[to_index(leg)]; };
  std::vector<int> order(places_m.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](int a, int b) { return place(a).y > place(b).y; });
  if (place(order[half - 1]).y - place(order[half]).y <= same_place_m) return {};

  const std::span<int> left(order.data(), half), right(order.data() + half, half);
  for (const std::span<int> side : {left, right}) {
    std::ranges::stable_sort(side, [&](int a, int b) { return place(a).x > place(b).x; });
    for (std::size_t i = 1; i < half; ++i)
      if (place(side[i - 1]).x - place(side[i]).x <= same_place_m) return {};
  }
  std::vector<LegPair> pairs;
  for (std::size_t i = 0; i < half; ++i) pairs.push_back({left[i], right[i]});
  return pairs;
}

}  // namespace amble::robot
