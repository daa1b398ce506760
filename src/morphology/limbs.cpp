#include "amble/morphology/limbs.hpp"

#include <algorithm>
#include <utility>

#include "amble/core/index.hpp"

namespace amble::morphology {
namespace {

/// Branches shorter than this share of the way from the trunk to their ends are toes; with more than two
/// joints (fingers) they must be shorter.
constexpr double toe_share = 0.35, finger_share = 0.25;
constexpr int most_toe_joints = 2;
/// A part that branches off is a lever if it reaches less far than this share of the body that carries it,
/// or of the longest branch beside it. Bodies that reach so many times as far are in other units.
constexpr double lever_share_of_body = 0.75, lever_share_of_branch = 0.5, absurd_reach = 20.0;

/// How far a shape reaches from a point.
double reach_of(const robot::Geom& geom, std::span<const robot::Pose> poses, Vec3 from) {
  const robot::Pose pose = poses[to_index(geom.body)] * robot::Pose{geom.position_m, geom.rotation};
  const Vec3 size = geom.size_m;
  std::vector<Vec3> ends{{}};
  if (geom.shape == robot::Shape::capsule || geom.shape == robot::Shape::cylinder)
    ends = {{0.0, 0.0, size.y}, {0.0, 0.0, -size.y}};
  if (geom.shape == robot::Shape::box)
    ends = {{size.x, 0.0, 0.0},  {-size.x, 0.0, 0.0}, {0.0, size.y, 0.0},
            {0.0, -size.y, 0.0}, {0.0, 0.0, size.z},  {0.0, 0.0, -size.z}};
  if (geom.shape == robot::Shape::mesh) ends = geom.vertices_m;
  double reach_m = 0.0;
  for (const Vec3 end : ends) reach_m = std::max(reach_m, norm(pose * end - from));
  return reach_m;
}

class LimbFinder {
 public:
  explicit LimbFinder(const ModelParts& parts) : parts_(parts), children_(parts.bodies.size()) {
    robot_.bodies = parts.bodies;
    robot_.joints = parts.joints;
    poses_ = robot::start_poses(robot_);
    for (int b = 1; b < count(); ++b) children_[to_index(parts_.bodies[to_index(b)].parent)].push_back(b);
    measure();
  }

  std::vector<Limb> find() {
    for (const int child : children_[0]) follow(0, child);
    std::ranges::sort(limbs_, {}, [](const Limb& limb) { return limb.bodies.back(); });
    return std::move(limbs_);
  }

 private:
  int count() const { return static_cast<int>(parts_.bodies.size()); }

  Vec3 anchor_m(int body) const {
    if (body == 0) return poses_[0].position_m;
    const std::vector<int> joints = robot_.joints_of_body(body);
    return poses_[to_index(body)] * parts_.joints[to_index(joints.front())].anchor_m;
  }

  /// How far a body's own shapes reach from its first joint: those that collide, else all, else its centre
  /// of mass.
  double own_reach_m(int body) const {
    const Vec3 from = anchor_m(body);
    for (const bool colliding : {true, false}) {
      double reach_m = 0.0;
      for (const robot::Geom& geom : parts_.geoms)
        if (geom.body == body && (geom.collides || !colliding))
          reach_m = std::max(reach_m, reach_of(geom, poses_, from));
      if (reach_m > 0.0) return reach_m;
    }
    return norm(poses_[to_index(body)] * parts_.bodies[to_index(body)].com_m - from);
  }

  void measure() {
    for (int b = 0; b < count(); ++b) own_m_.push_back(own_reach_m(b));
    reach_m_ = own_m_;
    joints_.assign(to_index(count()), 0);
    for (int b = count() - 1; b > 0; --b) {
      const auto parent = to_index(parts_.bodies[to_index(b)].parent);
      joints_[to_index(b)] += static_cast<int>(robot_.joints_of_body(b).size());
      reach_m_[parent] = std::max(reach_m_[parent], way_m(b));
      joints_[parent] = std::max(joints_[parent], joints_[to_index(b)]);
    }
  }

  /// From the parent's first joint to the end of the longest branch through this body.
  double way_m(int body) const {
    return norm(anchor_m(body) - anchor_m(parts_.bodies[to_index(body)].parent)) + reach_m_[to_index(body)];
  }

  /// Follows a chain from its first body behind the trunk.
  void follow(int trunk, int first) {
    Limb limb;
    limb.trunk = trunk;
    double way_to_m = 0.0;  // from the first joint to that of `body`
    for (int body = first;;) {
      limb.bodies.push_back(body);
      const std::vector<int> on = without_levers(body, limb);
      const bool ends = on.empty();
      if (ends || (on.size() > 1 && are_toes(on, body, way_to_m))) {
        limb.length_m = way_to_m + (ends ? own_m_[to_index(body)] : reach_m_[to_index(body)]);
        for (const int toe : on) add_branch(toe, limb.toe_joints, &limb.toes);
        for (const int b : limb.bodies)
          for (const int j : robot_.joints_of_body(b)) limb.joints.push_back(j);
        limbs_.push_back(std::move(limb));
        return;
      }
      if (on.size() > 1) {
        for (const int b : limb.bodies)
          for (const int child : children_[to_index(b)])
            if (std::ranges::find(limb.bodies, child) == limb.bodies.end()) follow(b, child);
        return;
      }
      way_to_m += norm(anchor_m(on[0]) - anchor_m(body));
      body = on[0];
    }
  }

  std::vector<int> without_levers(int body, Limb& limb) const {
    const std::vector<int>& children = children_[to_index(body)];
    double longest_m = 0.0;
    for (const int child : children) longest_m = std::max(longest_m, way_m(child));
    std::vector<int> on;
    for (const int child : children) {
      const double reach_m = way_m(child), own_m = own_m_[to_index(body)];
      const bool beside_body = reach_m < lever_share_of_body * own_m && own_m < absurd_reach * reach_m;
      if (beside_body || reach_m < lever_share_of_branch * longest_m)
        add_branch(child, limb.side_joints, nullptr);
      else
        on.push_back(child);
    }
    return on;
  }

  bool are_toes(const std::vector<int>& branches, int body, double way_to_m) const {
    return std::ranges::all_of(branches, [&](int b) {
      const double all_m = way_to_m + norm(anchor_m(b) - anchor_m(body)) + reach_m_[to_index(b)];
      const double share = joints_[to_index(b)] <= most_toe_joints ? toe_share : finger_share;
      return reach_m_[to_index(b)] < share * all_m;
    });
  }

  void add_branch(int body, std::vector<int>& joints, std::vector<int>* bodies) const {
    if (bodies != nullptr) bodies->push_back(body);
    for (const int j : robot_.joints_of_body(body)) joints.push_back(j);
    for (const int child : children_[to_index(body)]) add_branch(child, joints, bodies);
  }

  const ModelParts& parts_;
  robot::RobotSpec robot_;
  std::vector<robot::Pose> poses_;
  std::vector<std::vector<int>> children_;
  std::vector<double> own_m_, reach_m_;  ///< of a body itself, and with what hangs from it
  std::vector<int> joints_;              ///< of the longest chain from a body on, its own included
  std::vector<Limb> limbs_;
};

int lowest_geom(const ModelParts& parts, int body, std::span<const robot::Pose> poses, int lowest) {
  for (int g = 0; g < static_cast<int>(parts.geoms.size()); ++g) {
    const robot::Geom& geom = parts.geoms[to_index(g)];
    if (geom.body != body || !geom.collides) continue;
    if (lowest < 0 ||
        robot::bottom_m(geom, poses) < robot::bottom_m(parts.geoms[to_index(lowest)], poses) - 1e-9)
      lowest = g;
  }
  return lowest;
}

}  // namespace

std::vector<Limb> find_limbs(const ModelParts& parts) {
  return LimbFinder(parts).find();
}

int foot_geom(const ModelParts& parts, const Limb& limb, std::span<const robot::Pose> poses) {
  int foot = -1;
  for (const int toe : limb.toes) foot = lowest_geom(parts, toe, poses, foot);
  for (auto body = limb.bodies.rbegin(); body != limb.bodies.rend(); ++body) {
    foot = lowest_geom(parts, *body, poses, foot);
    if (foot >= 0) break;
  }
  return foot;
}

int end_geom(const ModelParts& parts, const Limb& limb, std::span<const robot::Pose> poses) {
  const robot::Joint& last = parts.joints[to_index(limb.joints.back())];
  const Vec3 from = poses[to_index(last.body)] * last.anchor_m;
  int end = -1;
  double farthest_m = -1.0;
  const int foot_body = parts.geoms[to_index(foot_geom(parts, limb, poses))].body;
  for (int g = 0; g < static_cast<int>(parts.geoms.size()); ++g) {
    const robot::Geom& geom = parts.geoms[to_index(g)];
    if (!geom.collides || geom.body != foot_body) continue;
    if (const double reach_m = reach_of(geom, poses, from); reach_m > farthest_m + 1e-9) {
      farthest_m = reach_m;
      end = g;
    }
  }
  return end;
}

Vec3 hip_m(const ModelParts& parts, const Limb& limb, std::span<const robot::Pose> poses) {
  const robot::Joint& joint = parts.joints[to_index(limb.joints.front())];
  return poses[to_index(joint.body)] * joint.anchor_m;
}

}  // namespace amble::morphology
