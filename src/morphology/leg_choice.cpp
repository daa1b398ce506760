#include "amble/morphology/leg_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include "amble/core/index.hpp"
#include "amble/morphology/leg_guess.hpp"

namespace amble::morphology {
namespace {

/// A limb ends near the ground if no higher than this share of the height of the centre of mass; where
/// something branches off behind its foot, this one.
constexpr double near_ground = 0.25, near_ground_with_lever = 0.1;
/// Legs of a robot have lengths within this ratio, and begin within this share of their length of a height.
constexpr double alike_length = 1.7, alike_height = 0.35;
/// Limbs of one group by structure are the same within this ratio in length, and nearly so within the other;
/// mirror images begin within this share of their length of their places.
constexpr double same_length = 1.03, group_length = 1.4, alike_place = 0.15;

constexpr std::array leg_words{"leg",   "thigh", "knee", "calf", "shin", "shank", "ankle", "foot",
                               "tibia", "femur", "coxa", "hfe",  "kfe",  "haa",   "hip"};
constexpr std::array other_words{"arm",  "hand", "wrist", "elbow", "finger",  "gripper", "neck",  "head",
                                 "tail", "wing", "jaw",   "claw",  "antenna", "camera",  "lidar", "thumb"};

/// What stands before a part's name in one word: "lhip", "upperarm".
constexpr std::array prefixes{"",      "l",     "r",    "f",     "b",     "h",   "m",  "fl",
                              "fr",    "rl",    "rr",   "lf",    "rf",    "lh",  "rh", "left",
                              "right", "front", "rear", "upper", "lower", "fore"};

/// Whether a word begins with one of these parts, with or without a prefix. Parts anywhere in a word would
/// find a hip in "whip" and a wing in "swing".
bool named_as(const std::vector<std::string>& words, std::span<const char* const> parts) {
  const auto begins = [](std::string_view word, std::string_view prefix, std::string_view part) {
    return word.starts_with(prefix) && word.substr(prefix.size()).starts_with(part);
  };
  return std::ranges::any_of(words, [&](const std::string& word) {
    return std::ranges::any_of(parts, [&](const char* part) {
      return std::ranges::any_of(prefixes, [&](const char* prefix) { return begins(word, prefix, part); });
    });
  });
}

class LegChooser {
 public:
  LegChooser(const ModelParts& parts, const std::vector<Limb>& limbs) : parts_(parts), limbs_(limbs) {
    robot_.bodies = parts.bodies;
    robot_.geoms = parts.geoms;
    robot_.joints = parts.joints;
    poses_ = robot::start_poses(robot_);
    for (const Limb& limb : limbs) {
      feet_.push_back(foot_geom(parts, limb, poses_));
      hips_m_.push_back(hip_m(parts, limb, poses_));
    }
  }

  LegChoice by_ground() {
    const double floor_m = robot::clearance_m(robot_, poses_);
    const double height_m = robot::start_com_m(robot_).z - floor_m;
    LegChoice choice;
    for (int l = 0; l < count(); ++l) {
      if (feet_[to_index(l)] < 0) continue;
      const double share = limbs_[to_index(l)].side_joints.empty() ? near_ground : near_ground_with_lever;
      const robot::Geom& foot = parts_.geoms[to_index(feet_[to_index(l)])];
      if (robot::bottom_m(foot, poses_) <= floor_m + share * height_m) choice.limbs.push_back(l);
    }
    leave_out_tails(choice);
    choice.why = fmt::format("chains of bodies whose end is at most {:.3g} m above the lowest point",
                             near_ground * height_m);
    add_counterparts(choice);
    return choice;
  }

  LegChoice by_structure(bool any_height) {
    std::vector<int> candidates;
    for (int l = 0; l < count(); ++l)
      if (feet_[to_index(l)] >= 0) candidates.push_back(l);
    const auto words = [&](int l) { return limb_words(parts_, limbs_[to_index(l)].joints); };
    std::vector<int> legs, not_arms;
    for (const int l : candidates) {
      const bool other = named_as(words(l), other_words);
      if (named_as(words(l), leg_words) && !other) legs.push_back(l);
      if (!other) not_arms.push_back(l);
    }
    if (legs.size() > 1)
      return {std::move(legs), "limbs whose joints and bodies are named as those of legs", {}};
    return {largest_group(not_arms.empty() ? candidates : not_arms, any_height),
            "the largest group of limbs with as many joints and about the same length",
            {}};
  }

 private:
  int count() const { return static_cast<int>(limbs_.size()); }

  /// A tail may rest on the ground; it is a leg where hardly anything else is.
  void leave_out_tails(LegChoice& choice) const {
    std::vector<int> others;
    for (const int l : choice.limbs)
      if (!is_tail(l)) others.push_back(l);
    if (others.size() > 1) choice.limbs = std::move(others);
  }
  bool is_tail(int l) const {
    constexpr std::array tail{"tail"};
    return named_as(limb_words(parts_, limb(l).joints), tail);
  }
  const Limb& limb(int l) const { return limbs_[to_index(l)]; }
  bool alike(int a, int b, double ratio) const {
    const double x = limb(a).length_m, y = limb(b).length_m;
    return limb(a).joints.size() == limb(b).joints.size() && x < ratio * y && y < ratio * x;
  }

  /// Mean of the legs' hips.
  Vec3 middle_m(const std::vector<int>& legs) const {
    Vec3 sum;
    for (const int l : legs) sum = sum + hips_m_[to_index(l)];
    return (1.0 / static_cast<double>(legs.size())) * sum;
  }

  void add_counterparts(LegChoice& choice) const {
    if (choice.limbs.empty()) return;
    std::vector<int> like;
    for (int l = 0; l < count(); ++l) {
      const bool is_leg = std::ranges::find(choice.limbs, l) != choice.limbs.end();
      const auto as_leg = [&](int k) { return alike(k, l, alike_length) && as_high(k, l); };
      if (!is_leg && feet_[to_index(l)] >= 0 && !is_tail(l) && std::ranges::any_of(choice.limbs, as_leg))
        like.push_back(l);
    }
    if (like.empty()) return;
    std::vector<int> all = choice.limbs;
    all.insert(all.end(), like.begin(), like.end());
    // Those that stand bear the robot as well as all would: arms, feelers.
    const Vec3 com = robot::start_com_m(robot_);
    const double length_m = limb(choice.limbs[0]).length_m;
    const auto off_m = [&](const std::vector<int>& legs) {
      const Vec3 off = com - middle_m(legs);
      return std::hypot(off.x, off.y);
    };
    constexpr double borne = 0.2, better = 0.6;
    if (off_m(choice.limbs) < borne * length_m || off_m(all) > better * off_m(choice.limbs)) return;
    choice.off_ground = like;
    std::ranges::sort(all);
    choice.limbs = std::move(all);
    choice.why += ", and limbs that have the joints of these";
  }

  bool as_high(int a, int b) const {
    return std::abs(hips_m_[to_index(a)].z - hips_m_[to_index(b)].z) < alike_height * limb(a).length_m;
  }

  /// The most limbs that are the same, and those that are nearly so and stand across from another.
  std::vector<int> largest_group(const std::vector<int>& candidates, bool any_height) const {
    std::vector<int> best;
    const auto members = [&](int of, double ratio) {
      std::vector<int> group;
      for (const int k : candidates)
        if (alike(of, k, ratio) && (any_height || as_high(of, k))) group.push_back(k);
      return group;
    };
    for (const int l : candidates) {
      std::vector<int> group = members(l, same_length);
      if (best.empty() || group.size() > best.size() ||
          (group.size() == best.size() && middle_m(group).z < middle_m(best).z - 1e-6))
        best = std::move(group);
    }
    if (best.empty()) return best;
    const Vec3 middle = middle_m(best);
    const std::vector<int> wide = members(best[0], group_length);
    std::vector<int> legs;
    for (const int l : wide) {
      const bool same = std::ranges::find(best, l) != best.end();
      // Where five or more are the same, one alone on the centre line is a tail or a neck.
      if (has_counterpart(l, wide, middle) || (same && best.size() < 5)) legs.push_back(l);
    }
    return legs.size() < best.size() && best.size() < 5 ? best : legs;
  }

  /// Whether another of these limbs begins as its mirror image, left and right or front and back.
  bool has_counterpart(int l, const std::vector<int>& of, Vec3 middle) const {
    const double near_m = alike_place * limb(l).length_m;
    const Vec3 a = hips_m_[to_index(l)];
    return std::ranges::any_of(of, [&](int k) {
      const Vec3 b = hips_m_[to_index(k)];
      const double x = std::abs(a.x - b.x), y = std::abs(a.y - b.y), z = std::abs(a.z - b.z);
      const double across_x = std::abs(a.x + b.x - 2.0 * middle.x),
                   across_y = std::abs(a.y + b.y - 2.0 * middle.y),
                   across_z = std::abs(a.z + b.z - 2.0 * middle.z);
      if (k == l) return false;
      return (x < near_m && z < near_m && across_y < near_m && y > near_m) ||
             (y < near_m && z < near_m && across_x < near_m && x > near_m) ||
             (x < near_m && y < near_m && across_z < near_m && z > near_m);
    });
  }

  const ModelParts& parts_;
  const std::vector<Limb>& limbs_;
  robot::RobotSpec robot_;
  std::vector<robot::Pose> poses_;
  std::vector<int> feet_;
  std::vector<Vec3> hips_m_;
};

}  // namespace

LegChoice choose_legs(const ModelParts& parts, const std::vector<Limb>& limbs, LegSearch search) {
  LegChooser chooser(parts, limbs);
  if (search != LegSearch::by_ground && search != LegSearch::either)
    return chooser.by_structure(search == LegSearch::any_height);
  LegChoice ground = chooser.by_ground();
  if (search == LegSearch::by_ground) return ground;
  LegChoice structure = chooser.by_structure(false);
  const bool more =
      structure.limbs.size() > ground.limbs.size() && std::ranges::includes(structure.limbs, ground.limbs);
  return more ? structure : ground;
}

std::vector<std::string> limb_words(const ModelParts& parts, const std::vector<int>& joints) {
  std::vector<std::string> words;
  for (const int j : joints) {
    const robot::Joint& joint = parts.joints[to_index(j)];
    for (const std::string& name : {joint.name, parts.bodies[to_index(joint.body)].name})
      for (std::string word : words_of(name)) {
        std::ranges::transform(word, word.begin(),
                               [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        words.push_back(std::move(word));
      }
  }
  return words;
}

}  // namespace amble::morphology
