#include "amble/morphology/facing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "amble/core/index.hpp"
#include "amble/morphology/leg_choice.hpp"
#include "amble/robot/pose.hpp"

namespace amble::morphology {
namespace {

/// Directions are told apart if they are within 37° of an axis.
constexpr double along_axis = 0.8;

enum class Side { none, one, other };

/// What the words of a leg say of its place: one is front or left, other is rear or right.
struct Place {
  Side lengthwise = Side::none, across = Side::none;
};

bool any_of(const std::vector<std::string>& words, std::initializer_list<const char*> parts) {
  return std::ranges::any_of(words, [&](const std::string& word) {
    return std::ranges::any_of(parts, [&](const char* part) { return word.find(part) != std::string::npos; });
  });
}

/// Also with a number behind, as in "l1".
bool is_one_of(const std::vector<std::string>& words, std::initializer_list<const char*> codes) {
  return std::ranges::any_of(words, [&](const std::string& word) {
    const std::size_t letters = word.find_last_not_of("0123456789") + 1;
    return std::ranges::any_of(codes, [&](const char* code) { return word.substr(0, letters) == code; });
  });
}

Side side_of(bool one, bool other) {
  return one == other ? Side::none : one ? Side::one : Side::other;
}

Place place_of(const std::vector<std::string>& words) {
  const bool front = any_of(words, {"front", "fore"}) || is_one_of(words, {"fl", "fr", "lf", "rf"});
  const bool rear = any_of(words, {"rear", "hind", "back"}) ||
                    is_one_of(words, {"rl", "rr", "hl", "hr", "lh", "rh", "bl", "br", "lb", "rb"});
  const bool left = any_of(words, {"left"}) ||
                    is_one_of(words, {"l", "fl", "rl", "hl", "bl", "lf", "lh", "lb", "lm", "ml"});
  const bool right = any_of(words, {"right"}) ||
                     is_one_of(words, {"r", "fr", "rr", "hr", "br", "rf", "rh", "rb", "rm", "mr"});
  return {side_of(front, rear), side_of(left, right)};
}

class Facing {
 public:
  Facing(const ModelParts& parts, const LegsGuess& legs) : parts_(parts), legs_(legs) {
    robot_.bodies = parts.bodies;
    robot_.geoms = parts.geoms;
    robot_.joints = parts.joints;
    poses_ = robot::start_poses(robot_);
    for (const LegGuess& leg : legs.legs) {
      const robot::Joint& hip = parts.joints[to_index(leg.joints.front())];
      hips_m_.push_back(poses_[to_index(hip.body)] * hip.anchor_m);
      feet_m_.push_back(robot::centre_m(parts.geoms[to_index(leg.foot_geom)], poses_));
    }
  }

  std::optional<RootTurn> to_x() const {
    std::string why = "the names of its legs";
    std::optional<Vec3> forward = by_names();
    if (!forward && legs_.legs.size() > 1) {
      forward = by_head();
      why = "its head and tail";
    }
    if (!forward && legs_.legs.size() > 1) {
      forward = by_rows();
      why = "its rows of legs and their hinges; from +y and -y the first was taken";
    }
    if (!forward) return std::nullopt;
    const Vec3 f = (1.0 / norm(*forward)) * *forward;
    constexpr double pi = std::numbers::pi;
    const Vec3 up{0.0, 0.0, 1.0};
    if (f.y > along_axis) return RootTurn{axis_angle(up, -0.5 * pi), "it faces +y, by " + why};
    if (f.y < -along_axis) return RootTurn{axis_angle(up, 0.5 * pi), "it faces -y, by " + why};
    if (f.x < -along_axis) return RootTurn{axis_angle(up, pi), "it faces -x, by " + why};
    return std::nullopt;
  }

  std::optional<RootTurn> upright(bool up) const {
    if (legs_.legs.size() < 2) return std::nullopt;
    const std::vector<Limb> limbs = find_limbs(parts_);
    Vec3 sum, middle;
    double lengths_m = 0.0;
    for (std::size_t l = 0; l < hips_m_.size(); ++l) {
      const Limb& limb = limbs[to_index(legs_.legs[l].limb)];
      const int end = end_geom(parts_, limb, poses_);
      sum = sum + robot::centre_m(parts_.geoms[to_index(end)], poses_) - hips_m_[l];
      lengths_m += limb.length_m;
      middle = middle + (1.0 / static_cast<double>(hips_m_.size())) * hips_m_[l];
    }
    // Stretched, and all the same way.
    constexpr double together = 0.7, steep = 0.7, opposite = 0.5, level = 0.5, behind = 0.15;
    if (!(norm(sum) > together * lengths_m)) return std::nullopt;
    const Vec3 down = (1.0 / norm(sum)) * sum;
    if (down.z < -steep) return std::nullopt;
    const Vec3 trunk = trunk_com_m() - middle;
    const double leg_m = lengths_m / static_cast<double>(hips_m_.size());
    const bool trunk_behind = dot(trunk, down) < -opposite * norm(trunk) && norm(trunk) > behind * leg_m;
    const bool points_up = down.z > steep;
    if (points_up && !up) return std::nullopt;
    if (!points_up && !trunk_behind && std::abs(plane_normal().z) > level) return std::nullopt;
    return RootTurn{turn_between(snapped(down), {0.0, 0.0, -1.0}),
                    fmt::format("its legs point along {}", text(down))};
  }

 private:
  std::optional<Vec3> by_names() const {
    std::array<Vec3, 4> sums{};  // front, rear, left, right
    std::array<int, 4> counts{};
    for (std::size_t l = 0; l < legs_.legs.size(); ++l) {
      const Place place = place_of(limb_words(parts_, legs_.legs[l].joints));
      const auto add = [&](Side side, std::size_t at) {
        if (side == Side::none) return;
        const std::size_t where = at + (side == Side::one ? 0 : 1);
        // A foot counts as well: hips may be in one place.
        sums[where] = sums[where] + hips_m_[l] + 0.1 * feet_m_[l];
        ++counts[where];
      };
      add(place.lengthwise, 0);
      add(place.across, 2);
    }
    const auto between = [&](std::size_t one) -> std::optional<Vec3> {
      if (counts[one] == 0 || counts[one + 1] == 0) return std::nullopt;
      Vec3 d = (1.0 / counts[one]) * sums[one] - (1.0 / counts[one + 1]) * sums[one + 1];
      d.z = 0.0;
      if (!(norm(d) > 1e-3)) return std::nullopt;
      return d;
    };
    const auto lengthwise = between(0), across = between(2);
    // Forward is 90° to the right of left.
    const auto ahead = across ? std::optional<Vec3>({across->y, -across->x, 0.0}) : std::nullopt;
    if (lengthwise && ahead && dot(*lengthwise, *ahead) < 0.5 * norm(*lengthwise) * norm(*ahead))
      return std::nullopt;
    return lengthwise ? lengthwise : ahead;
  }

  /// From the hips towards a head, or away from a tail, that lies beyond them.
  std::optional<Vec3> by_head() const {
    Vec3 least = hips_m_[0], most = hips_m_[0];
    for (const Vec3 hip : hips_m_) {
      least = {std::min(least.x, hip.x), std::min(least.y, hip.y), 0.0};
      most = {std::max(most.x, hip.x), std::max(most.y, hip.y), 0.0};
    }
    std::set<int> of_legs;
    for (const LegGuess& leg : legs_.legs)
      for (const int j : leg.joints) of_legs.insert(parts_.joints[to_index(j)].body);
    for (std::size_t b = 1; b < parts_.bodies.size(); ++b) {
      if (of_legs.contains(static_cast<int>(b))) continue;
      const std::vector<std::string> words = small_words(parts_.bodies[b].name);
      const bool head = any_of(words, {"head", "neck", "snout", "nose", "muzzle"}),
                 tail = any_of(words, {"tail"});
      if (head == tail) continue;
      const Vec3 at = poses_[b] * parts_.bodies[b].com_m;
      const double beyond_x = std::max(at.x - most.x, least.x - at.x);
      const double beyond_y = std::max(at.y - most.y, least.y - at.y);
      if (std::max(beyond_x, beyond_y) <= 0.0) continue;
      const double way = head ? 1.0 : -1.0;
      if (beyond_x > beyond_y) return Vec3{at.x > most.x ? way : -way, 0.0, 0.0};
      // A robot on legs to its left and right alone has its head above them.
      if (legs_.legs.size() > 2) return Vec3{0.0, at.y > most.y ? way : -way, 0.0};
    }
    return std::nullopt;
  }

  static std::vector<std::string> small_words(const std::string& name) {
    std::vector<std::string> words = words_of(name);
    for (std::string& word : words)
      for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return words;
  }

  /// +y if the legs step along y, and stand in rows along y; two legs stand beside each other along x.
  std::optional<Vec3> by_rows() const {
    double step_x = 0.0, step_y = 0.0;
    for (std::size_t l = 0; l < legs_.legs.size(); ++l) {
      Vec3 axes;
      bool yaws = false;
      for (const int j : legs_.legs[l].joints) {
        const robot::Joint& joint = parts_.joints[to_index(j)];
        const Vec3 axis = rotate(poses_[to_index(joint.body)].rotation, joint.axis);
        yaws = yaws || std::abs(axis.z) > along_axis;
        axes = axes + Vec3{std::abs(axis.x), std::abs(axis.y), 0.0};
      }
      // A leg that stands out to the side and turns about z steps along the hinges of its knee.
      const Vec3 out = feet_m_[l] - hips_m_[l];
      const bool sprawls = yaws && std::hypot(out.x, out.y) > 0.5 * std::abs(out.z) && legs_.legs.size() > 2;
      step_x += sprawls ? axes.x : axes.y;
      step_y += sprawls ? axes.y : axes.x;
    }
    constexpr double clearly = 1.5, longer = 1.1;
    if (step_y < clearly * step_x) return std::nullopt;
    Vec3 least = hips_m_[0], most = hips_m_[0];
    for (const Vec3 hip : hips_m_) {
      least = {std::min(least.x, hip.x), std::min(least.y, hip.y), 0.0};
      most = {std::max(most.x, hip.x), std::max(most.y, hip.y), 0.0};
    }
    const double wide_x = most.x - least.x, wide_y = most.y - least.y;
    const bool rows = legs_.legs.size() == 2 ? wide_x > longer * wide_y : wide_y > longer * wide_x;
    return rows ? std::optional<Vec3>({0.0, 1.0, 0.0}) : std::nullopt;
  }

  /// The centre of mass of all that is of no leg.
  Vec3 trunk_com_m() const {
    std::vector<bool> of_leg(parts_.bodies.size(), false);
    for (const LegGuess& leg : legs_.legs)
      for (const int j : leg.joints) of_leg[to_index(parts_.joints[to_index(j)].body)] = true;
    Vec3 moment;
    double mass_kg = 0.0;
    for (std::size_t b = 0; b < parts_.bodies.size(); ++b) {
      if (of_leg[b]) continue;
      moment = moment + parts_.bodies[b].mass_kg * (poses_[b] * parts_.bodies[b].com_m);
      mass_kg += parts_.bodies[b].mass_kg;
    }
    return (1.0 / mass_kg) * moment;
  }

  /// The normal of the plane of the hips; up if they lie on a line.
  Vec3 plane_normal() const {
    Vec3 best{0.0, 0.0, 1.0};
    double largest = 0.0;
    for (std::size_t a = 1; a < hips_m_.size(); ++a)
      for (std::size_t b = a + 1; b < hips_m_.size(); ++b) {
        const Vec3 one = hips_m_[a] - hips_m_[0], two = hips_m_[b] - hips_m_[0], normal = cross(one, two);
        if (norm(normal) <= largest || norm(normal) < 0.1 * norm(one) * norm(two)) continue;
        largest = norm(normal);
        best = (1.0 / largest) * normal;
      }
    return best;
  }

  /// The axis that a direction is within 20° of, else itself.
  static Vec3 snapped(Vec3 v) {
    constexpr double near = 0.94;
    for (const Vec3 axis : {Vec3{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}})
      if (dot(axis, v) > near) return axis;
    return v;
  }

  static Quat turn_between(Vec3 from, Vec3 to) {
    const Vec3 axis = cross(from, to);
    if (norm(axis) < 1e-9) return axis_angle({1.0, 0.0, 0.0}, dot(from, to) > 0.0 ? 0.0 : std::numbers::pi);
    return axis_angle((1.0 / norm(axis)) * axis, std::atan2(norm(axis), dot(from, to)));
  }

  static std::string text(Vec3 v) {
    const std::array sizes{std::abs(v.x), std::abs(v.y), std::abs(v.z)};
    const auto largest = std::ranges::max_element(sizes) - sizes.begin();
    const double value = largest == 0 ? v.x : largest == 1 ? v.y : v.z;
    return fmt::format("{}{}", value < 0.0 ? '-' : '+', "xyz"[largest]);
  }

  const ModelParts& parts_;
  const LegsGuess& legs_;
  robot::RobotSpec robot_;
  std::vector<robot::Pose> poses_;
  std::vector<Vec3> hips_m_, feet_m_;
};

}  // namespace

std::optional<RootTurn> turn_to_face_x(const ModelParts& parts, const LegsGuess& legs) {
  if (legs.legs.empty()) return std::nullopt;
  return Facing(parts, legs).to_x();
}

std::optional<RootTurn> turn_upright(const ModelParts& parts, const LegsGuess& legs, bool up) {
  if (legs.legs.empty()) return std::nullopt;
  return Facing(parts, legs).upright(up);
}

}  // namespace amble::morphology
