#include "amble/morphology/leg_guess.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "amble/core/index.hpp"
#include "amble/morphology/foot_shapes.hpp"
#include "amble/robot/pose.hpp"

namespace amble::morphology {
namespace {

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::ranges::find(words, word) != words.end();
}

class LegNamer {
 public:
  explicit LegNamer(const ModelParts& parts) : parts_(parts) {
    robot_.bodies = parts.bodies;
    robot_.geoms = parts.geoms;
    robot_.joints = parts.joints;
    poses_ = robot::start_poses(robot_);
  }

  LegsGuess name(const LegChoice& choice) {
    const std::vector<Limb> limbs = find_limbs(parts_);
    for (const int l : choice.limbs) {
      const Limb& limb = limbs[to_index(l)];
      LegGuess leg{.name = {},
                   .limb = l,
                   .joints = {},
                   .foot_geom = foot_geom(parts_, limb, poses_),
                   .foot_geoms = {},
                   .joint_of_type = {}};
      std::ranges::copy_if(limb.joints, std::back_inserter(leg.joints),
                           [&](int j) { return parts_.drives[to_index(j)] == Drive::motor; });
      if (leg.joints.empty()) continue;
      leg.foot_geoms = foot_shapes(parts_, poses_, leg.joints, leg.foot_geom);
      guess_.legs.push_back(std::move(leg));
    }
    guess_.why_legs = choice.why;
    if (!guess_.legs.empty()) {
      name_legs();
      name_types();
      order_legs();
    }
    std::set<int> of_legs;
    for (const LegGuess& leg : guess_.legs) of_legs.insert(leg.joints.begin(), leg.joints.end());
    for (int j = 0; j < static_cast<int>(parts_.joints.size()); ++j)
      if (!of_legs.contains(j))
        (parts_.drives[to_index(j)] == Drive::none ? guess_.passive : guess_.held).push_back(j);
    return std::move(guess_);
  }

 private:
  const std::string& joint_name(int j) const { return parts_.joints[to_index(j)].name; }

  /// Words that all joints of a leg share, and not all joints of all legs.
  std::vector<std::vector<std::string>> own_words(bool digits_apart) const {
    std::vector<std::vector<std::string>> own;
    for (const LegGuess& leg : guess_.legs) {
      std::vector<std::string> shared = words_of(joint_name(leg.joints.front()), digits_apart);
      for (const int j : leg.joints) {
        const auto words = words_of(joint_name(j), digits_apart);
        std::erase_if(shared, [&](const std::string& word) { return !contains(words, word); });
      }
      own.push_back(std::move(shared));
    }
    drop_words_of_types(own, digits_apart);
    const auto everywhere = own.front();
    for (const std::string& word : everywhere)
      if (std::ranges::all_of(own, [&](const auto& words) { return contains(words, word); }))
        for (auto& words : own) std::erase(words, word);
    return own;
  }

  /// A leg of one joint shares all words with itself: those that only some joints of another leg have are
  /// words of a type, and go where another word is left.
  void drop_words_of_types(std::vector<std::vector<std::string>>& own, bool digits_apart) const {
    const auto shared = own;
    for (std::size_t l = 0; l < own.size(); ++l) {
      std::vector<std::string> left = own[l];
      std::erase_if(left, [&](const std::string& word) {
        for (std::size_t k = 0; k < own.size(); ++k)
          for (const int j : guess_.legs[k].joints)
            if (!contains(shared[k], word) && contains(words_of(joint_name(j), digits_apart), word))
              return true;
        return false;
      });
      if (!left.empty()) own[l] = std::move(left);
    }
  }

  /// Gives the legs these names if they are good ones.
  bool take_names(std::vector<std::string> names) {
    std::set<std::string> different;
    for (std::string& name : names) {
      if (name.empty()) return false;
      if (std::isdigit(static_cast<unsigned char>(name[0])) != 0) name.insert(0, "leg");
      if (name == "foot" || name == "joint" || !different.insert(name).second) return false;
    }
    for (std::size_t l = 0; l < names.size(); ++l) guess_.legs[l].name = names[l];
    return true;
  }

  /// What the names of a leg's joints begin with: "b" of "bthigh" and "bshin".
  static std::string common_beginning(const std::vector<std::string>& names) {
    std::string common = names.front();
    for (const std::string& name : names) {
      std::size_t same = 0;
      while (same < std::min(common.size(), name.size()) && common[same] == name[same]) ++same;
      common.resize(same);
    }
    // Not amid a character of UTF-8.
    const auto goes_on = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; };
    while (!common.empty() && std::ranges::any_of(names, [&](const std::string& name) {
      return common.size() < name.size() && goes_on(name[common.size()]);
    }))
      common.pop_back();
    return common;
  }

  /// With a "left" one, a leg without a word of its own is the right one.
  static void name_the_other(std::vector<std::string>& names) {
    if (names.size() != 2) return;
    for (std::size_t l = 0; l < 2; ++l) {
      if (!names[l].empty()) continue;
      if (names[1 - l] == "left") names[l] = "right";
      if (names[1 - l] == "right") names[l] = "left";
    }
  }

  void name_legs() {
    if (guess_.legs.size() > 1) {
      for (const bool digits_apart : {false, true}) {
        std::vector<std::string> names;
        own_words_ = own_words(digits_apart);
        digits_apart_ = digits_apart;
        for (const auto& words : own_words_) names.push_back(fmt::format("{}", fmt::join(words, "_")));
        name_the_other(names);
        if (take_names(names)) {
          guess_.why_names = "the words that the names of a leg's joints share";
          return;
        }
      }
    }
    own_words_.assign(guess_.legs.size(), {});
    digits_apart_ = false;
    std::vector<std::string> beginnings;
    for (const LegGuess& leg : guess_.legs) {
      std::vector<std::string> names;
      for (const int j : leg.joints) names.push_back(joint_name(j));
      beginnings.push_back(leg.joints.size() > 1 ? common_beginning(names) : "");
    }
    beginnings_ = beginnings;
    if (guess_.legs.size() > 1 && take_names(beginnings)) {
      guess_.why_names = "what the names of a leg's joints begin with";
      return;
    }
    beginnings_.clear();
    guess_.why_names = "by place: the names of joints do not tell";
    if (take_names(places())) return;
    std::vector<std::string> numbers;
    for (std::size_t l = 0; l < guess_.legs.size(); ++l) numbers.push_back(fmt::format("leg{}", l + 1));
    take_names(numbers);
  }

  /// Where a leg begins, in the world.
  Vec3 hip_m(const LegGuess& leg) const {
    const robot::Joint& joint = parts_.joints[to_index(leg.joints.front())];
    return poses_[to_index(joint.body)] * joint.anchor_m;
  }

  std::vector<std::string> places() const {
    if (guess_.legs.size() == 1) return {"leg"};
    std::vector<std::string> sides;
    for (const LegGuess& leg : guess_.legs) {
      const Vec3 foot = robot::centre_m(parts_.geoms[to_index(leg.foot_geom)], poses_);
      const double y = 0.5 * (foot.y + hip_m(leg).y);
      sides.push_back(y > 1e-3 ? "left" : y < -1e-3 ? "right" : "");
    }
    std::vector<std::string> names;
    for (std::size_t l = 0; l < guess_.legs.size(); ++l) {
      // Its place among the legs of its side, from the front.
      std::size_t of_side = 0, before = 0;
      for (std::size_t k = 0; k < guess_.legs.size(); ++k) {
        if (sides[k] != sides[l]) continue;
        ++of_side;
        const double ahead = hip_m(guess_.legs[k]).x - hip_m(guess_.legs[l]).x;
        before += ahead > 1e-6 || (std::abs(ahead) <= 1e-6 && k < l) ? 1 : 0;
      }
      std::string row;
      if (of_side == 2) row = before == 0 ? "front" : "rear";
      if (of_side == 3) row = before == 0 ? "front" : before == 1 ? "middle" : "rear";
      if (of_side > 3) row = fmt::format("row{}", before + 1);
      names.push_back(row.empty() || sides[l].empty() ? row + sides[l] : row + "_" + sides[l]);
    }
    return names;
  }

  /// A joint's name without the words of its leg and those of all joints of legs.
  std::string type_by_name(std::size_t leg, int j, const std::vector<std::string>& common) const {
    const std::size_t beginning = beginnings_.empty() ? 0 : beginnings_[leg].size();
    std::vector<std::string> words = words_of(joint_name(j).substr(beginning), digits_apart_);
    std::erase_if(words, [&](const std::string& word) {
      return contains(own_words_[leg], word) || contains(common, word);
    });
    return fmt::format("{}", fmt::join(words, "_"));
  }

  std::vector<std::string> types_of_leg(std::size_t l, bool by_name,
                                        const std::vector<std::string>& common) const {
    std::vector<std::string> types;
    std::map<std::string, int> met;
    for (auto j = guess_.legs[l].joints.rbegin(); j != guess_.legs[l].joints.rend(); ++j) {
      if (by_name) {
        types.push_back(type_by_name(l, *j, common));
        continue;
      }
      const robot::Joint& joint = parts_.joints[to_index(*j)];
      const Vec3 axis = rotate(poses_[to_index(joint.body)].rotation, joint.axis);
      const double x = std::abs(axis.x), y = std::abs(axis.y), z = std::abs(axis.z);
      const std::string turn = y >= x && y >= z ? "pitch" : x >= z ? "roll" : "yaw";
      const int number = ++met[turn];
      types.push_back(number == 1 ? turn : fmt::format("{}{}", turn, number));
    }
    return types;
  }

  void name_types() {
    std::vector<std::string> common = words_of(joint_name(guess_.legs[0].joints[0]), digits_apart_);
    std::size_t joints = 0, most = 0;
    for (const LegGuess& leg : guess_.legs) {
      most = std::max(most, leg.joints.size());
      for (const int j : leg.joints) {
        ++joints;
        const auto words = words_of(joint_name(j), digits_apart_);
        std::erase_if(common, [&](const std::string& word) { return !contains(words, word); });
      }
    }
    // With one joint a common word is all there is.
    if (joints == guess_.legs.size()) common.clear();
    for (const bool by_name : {true, false}) {
      if (!take_types(by_name, common, by_name ? most + 2 : joints)) continue;
      guess_.why_types = by_name ? "what is left of the joints' names; from the foot to the trunk"
                                 : "by axis: the names of joints do not tell; from the foot to the trunk";
      return;
    }
  }

  bool is_joint_of_no_leg(const std::string& name) const {
    const auto joint = std::ranges::find(parts_.joints, name, &robot::Joint::name);
    const auto number = static_cast<int>(joint - parts_.joints.begin());
    return joint != parts_.joints.end() && std::ranges::none_of(guess_.legs, [number](const LegGuess& leg) {
             return std::ranges::find(leg.joints, number) != leg.joints.end();
           });
  }

  bool take_types(bool by_name, const std::vector<std::string>& common, std::size_t most) {
    std::vector<std::string> all;
    std::vector<std::vector<std::string>> by_leg;
    for (std::size_t l = 0; l < guess_.legs.size(); ++l) {
      std::vector<std::string> types = types_of_leg(l, by_name, common);
      auto place = all.begin();
      for (std::string& type : types) {
        if (type.empty() || std::ranges::count(types, type) > 1) return false;
        if (type == "foot" || type == "joint" || std::isdigit(static_cast<unsigned char>(type[0])) != 0)
          type += "_hinge";
        if (std::isdigit(static_cast<unsigned char>(type[0])) != 0) type.insert(0, "j");
        for (const LegGuess& leg : guess_.legs)
          if (leg.name == type) type += "_hinge";
        if (is_joint_of_no_leg(type)) type += "_hinge";
        const auto found = std::ranges::find(all, type);
        place = found != all.end() ? found + 1 : all.insert(place, type) + 1;
      }
      by_leg.push_back(std::move(types));
    }
    if (all.size() > most) return false;
    for (std::size_t l = 0; l < guess_.legs.size(); ++l) {
      LegGuess& leg = guess_.legs[l];
      leg.joint_of_type.assign(all.size(), -1);
      for (std::size_t t = 0; t < by_leg[l].size(); ++t) {
        const auto type = std::ranges::find(all, by_leg[l][t]) - all.begin();
        leg.joint_of_type[to_index(type)] = leg.joints[leg.joints.size() - 1 - t];
      }
    }
    guess_.joint_types = std::move(all);
    return true;
  }

  /// From the front, and left before right: the order in which gaits are drawn.
  void order_legs() {
    const auto before = [this](const LegGuess& a, const LegGuess& b) {
      const Vec3 p = hip_m(a), q = hip_m(b);
      return std::abs(p.x - q.x) > 1e-3 ? p.x > q.x : p.y > q.y + 1e-6;
    };
    std::stable_sort(guess_.legs.begin(), guess_.legs.end(), before);
  }

  const ModelParts& parts_;
  robot::RobotSpec robot_;
  std::vector<robot::Pose> poses_;
  std::vector<std::vector<std::string>> own_words_;
  std::vector<std::string> beginnings_;  ///< per leg, if the legs are named by them
  bool digits_apart_ = false;
  LegsGuess guess_;
};

}  // namespace

std::vector<std::string> words_of(const std::string& name, bool digits_apart) {
  std::vector<std::string> words;
  bool open = false;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto c = static_cast<unsigned char>(name[i]);
    if (std::isalnum(c) == 0 && c < 0x80) {  // bytes of UTF-8 beyond ASCII are letters
      open = false;
      continue;
    }
    const unsigned char last = i > 0 ? static_cast<unsigned char>(name[i - 1]) : ' ';
    const bool next_is_small =
        i + 1 < name.size() && std::islower(static_cast<unsigned char>(name[i + 1])) != 0;
    const bool hump =
        std::isupper(c) != 0 && (std::islower(last) != 0 || (std::isupper(last) != 0 && next_is_small));
    const bool number = digits_apart && (std::isdigit(c) != 0) != (std::isdigit(last) != 0);
    if (!open || hump || number) words.emplace_back();
    open = true;
    words.back() += name[i];
  }
  return words;
}

LegsGuess guess_legs(const ModelParts& parts, const LegChoice& choice) {
  return LegNamer(parts).name(choice);
}

LegsGuess guess_legs(const ModelParts& parts) {
  return guess_legs(parts, choose_legs(parts, find_limbs(parts), LegSearch::by_ground));
}

bool lacks_motors(const ModelParts& parts, const LegChoice& choice) {
  const std::vector<Limb> limbs = find_limbs(parts);
  const auto driven = std::ranges::count_if(choice.limbs, [&](int l) {
    return std::ranges::any_of(limbs[to_index(l)].joints,
                               [&](int j) { return parts.drives[to_index(j)] == Drive::motor; });
  });
  return 2 * driven < std::ssize(choice.limbs);
}

double longest_leg_m(const ModelParts& parts, const LegsGuess& legs) {
  robot::RobotSpec robot;
  robot.bodies = parts.bodies;
  const auto poses = robot::start_poses(robot);
  double longest = 0.0;
  for (const LegGuess& leg : legs.legs) {
    double length = 0.0;
    Vec3 end = foot_centre_m(parts, leg.foot_geoms, poses);
    for (auto j = leg.joints.rbegin(); j != leg.joints.rend(); ++j) {
      const robot::Joint& joint = parts.joints[to_index(*j)];
      const Vec3 anchor = poses[to_index(joint.body)] * joint.anchor_m;
      length += norm(end - anchor);
      end = anchor;
    }
    longest = std::max(longest, length);
  }
  return longest > 0.0 ? longest : 0.1;
}

}  // namespace amble::morphology
