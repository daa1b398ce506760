#include "amble/morphology/foot_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "amble/core/index.hpp"
#include "amble/robot/legs.hpp"

namespace amble::morphology {
namespace {

/// Differences of heights that are rounding, as a share of the leg's length.
constexpr double level_share = 2e-3;

/// The body that moves a body by a motor: itself, or the next above without motors between.
int moved_with(const ModelParts& parts, int body) {
  for (; body > 0; body = parts.bodies[to_index(body)].parent)
    for (std::size_t j = 0; j < parts.joints.size(); ++j)
      if (parts.joints[j].body == body && parts.drives[j] == Drive::motor) return body;
  return 0;
}

/// From the hip from joint to joint to a place.
double leg_length_m(const ModelParts& parts, const std::vector<robot::Pose>& poses,
                    const std::vector<int>& joints, Vec3 end) {
  double length_m = 0.0;
  for (auto j = joints.rbegin(); j != joints.rend(); ++j) {
    const robot::Joint& joint = parts.joints[to_index(*j)];
    const Vec3 anchor = poses[to_index(joint.body)] * joint.anchor_m;
    length_m += norm(end - anchor);
    end = anchor;
  }
  return length_m;
}

/// Those of the shapes that are the lowest with all of them tilted in some direction.
std::set<int> first_to_touch(const ModelParts& parts, const std::vector<robot::Pose>& poses,
                             const std::vector<int>& shapes, double level_m) {
  constexpr int directions = 16, steps = 2;
  std::set<int> first;
  for (int step = 0; step <= steps; ++step)
    for (int d = 0; d < (step == 0 ? 1 : directions); ++d) {
      const double turn = 2.0 * std::numbers::pi * d / directions;
      const Quat tilt = axis_angle({std::cos(turn), std::sin(turn), 0.0},
                                   foot_tilt_rad * step / static_cast<double>(steps));
      std::vector<robot::Pose> tilted;
      tilted.reserve(poses.size());
      for (const robot::Pose& pose : poses) tilted.push_back(robot::Pose{{}, tilt} * pose);
      std::vector<double> bottoms_m;
      bottoms_m.reserve(shapes.size());
      for (const int g : shapes) bottoms_m.push_back(robot::bottom_m(parts.geoms[to_index(g)], tilted));
      const double lowest_m = *std::ranges::min_element(bottoms_m);
      for (std::size_t i = 0; i < shapes.size(); ++i)
        if (bottoms_m[i] <= lowest_m + level_m) first.insert(shapes[i]);
    }
  return first;
}

/// Behind the toes of the lowest shape: those of the links that the leg's other joints move which are on the
/// ground too, as long as these joints are near it.
std::vector<int> soles_above(const ModelParts& parts, const std::vector<robot::Pose>& poses,
                             const std::vector<int>& joints, int lowest, double length_m) {
  const double ground_m = robot::bottom_m(parts.geoms[to_index(lowest)], poses);
  const int toe = moved_with(parts, parts.geoms[to_index(lowest)].body);
  std::vector<int> soles;
  for (auto j = joints.rbegin(); j != joints.rend(); ++j) {
    const robot::Joint& joint = parts.joints[to_index(*j)];
    if ((poses[to_index(joint.body)] * joint.anchor_m).z - ground_m > foot_share * length_m) break;
    if (joint.body == toe) continue;
    for (int g = 0; g < static_cast<int>(parts.geoms.size()); ++g) {
      const robot::Geom& geom = parts.geoms[to_index(g)];
      if (geom.collides && moved_with(parts, geom.body) == joint.body &&
          robot::bottom_m(geom, poses) <= ground_m + level_share * length_m &&
          std::ranges::find(soles, g) == soles.end())
        soles.push_back(g);
    }
  }
  return soles;
}

std::vector<int> with(int lowest, const std::vector<int>& others) {
  std::vector<int> all{lowest};
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

}  // namespace

std::vector<int> foot_shapes(const ModelParts& parts, const std::vector<robot::Pose>& poses,
                             const std::vector<int>& joints, int lowest) {
  const robot::Geom& foot = parts.geoms[to_index(lowest)];
  const int moved = moved_with(parts, foot.body);
  std::vector<int> shapes;
  for (int g = 0; g < static_cast<int>(parts.geoms.size()); ++g) {
    const robot::Geom& geom = parts.geoms[to_index(g)];
    if (geom.collides && moved_with(parts, geom.body) == moved) shapes.push_back(g);
  }
  if (joints.empty() || moved == 0) return {lowest};
  const Vec3 end = robot::centre_m(foot, poses);
  const double length_m = leg_length_m(parts, poses, joints, end);
  const std::vector<int> soles = soles_above(parts, poses, joints, lowest, length_m);
  if (shapes.size() <= 1) return with(lowest, soles);

  const robot::Joint& last = parts.joints[to_index(joints.back())];
  const double last_m = norm(end - poses[to_index(last.body)] * last.anchor_m);
  std::set<int> chosen;
  if (last_m < foot_share * length_m)
    chosen.insert(shapes.begin(), shapes.end());
  else
    chosen = first_to_touch(parts, poses, shapes, level_share * length_m);
  std::set<int> links;
  for (const int g : chosen)
    if (const int link = parts.welded_links[to_index(g)]; link >= 0) links.insert(link);
  for (const int g : shapes)
    if (links.contains(parts.welded_links[to_index(g)])) chosen.insert(g);

  chosen.insert(soles.begin(), soles.end());
  chosen.erase(lowest);
  return with(lowest, {chosen.begin(), chosen.end()});
}

Vec3 foot_centre_m(const ModelParts& parts, const std::vector<int>& shapes,
                   const std::vector<robot::Pose>& poses) {
  robot::RobotSpec robot;
  robot.geoms = parts.geoms;
  return robot::foot_m(robot, {.name = {}, .foot_geoms = shapes, .joints = {}}, poses);
}

}  // namespace amble::morphology
