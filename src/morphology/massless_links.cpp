#include "amble/morphology/massless_links.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/robot/pose.hpp"

namespace amble::morphology {
namespace {

class LinkMerger {
 public:
  explicit LinkMerger(ModelParts& parts) : parts_(parts) {}

  std::string merge() {
    std::vector<std::string> merged, ends, faulty;
    for (int b = static_cast<int>(parts_.bodies.size()) - 1; b >= 0; --b) {
      const robot::Body& body = parts_.bodies[to_index(b)];
      if (body.mass_kg > 0.0) continue;
      const std::string name = fmt::format("'{}'", body.name);
      const std::vector<int> children = children_of(b);
      const bool shows =
          std::ranges::any_of(parts_.geoms, [&](const robot::Geom& geom) { return geom.body == b; });
      if (b == 0 || shows || children.size() > 1) {
        faulty.push_back(name);
      } else if (children.empty()) {
        ends.push_back(fmt::format("{} (joint {})", name, fmt::join(joints_of(b), ", ")));
        remove_joints_of(b);
        remove_body(b);
      } else {
        merged.push_back(name);
        give_joints(b, children[0]);
        remove_body(b);
      }
    }
    const auto note = [&](Reading reading, const char* what, std::vector<std::string>& names) {
      std::ranges::reverse(names);
      if (!names.empty()) parts_.notes.add(reading, fmt::format("{}: {}", what, fmt::join(names, ", ")));
    };
    note(Reading::replaced,
         "links without mass and shape, whose joints are now those of the link behind them", merged);
    note(Reading::left_out, "links without mass and shape at the end of a limb", ends);
    std::ranges::reverse(faulty);
    return fmt::format("{}", fmt::join(faulty, ", "));
  }

 private:
  std::vector<int> children_of(int b) const {
    std::vector<int> children;
    for (int c = 0; c < static_cast<int>(parts_.bodies.size()); ++c)
      if (parts_.bodies[to_index(c)].parent == b) children.push_back(c);
    return children;
  }

  std::vector<std::string> joints_of(int b) const {
    std::vector<std::string> names;
    for (const robot::Joint& joint : parts_.joints)
      if (joint.body == b) names.push_back(fmt::format("'{}'", joint.name));
    return names;
  }

  /// In the start pose both are fixed to each other, and a joint's place and axis are given there.
  void give_joints(int from, int to) {
    const robot::Body& link = parts_.bodies[to_index(from)];
    robot::Body& child = parts_.bodies[to_index(to)];
    const robot::Pose in_link{child.position_m, child.rotation};
    int given = 0;
    for (robot::Joint& joint : parts_.joints) {
      if (joint.body != from) continue;
      joint.body = to;
      joint.anchor_m = rotate(conjugate(in_link.rotation), joint.anchor_m - in_link.position_m);
      joint.axis = rotate(conjugate(in_link.rotation), joint.axis);
      joint.chain_index -= most_joints;  // marked
      ++given;
    }
    for (robot::Joint& joint : parts_.joints)
      if (joint.body == to) joint.chain_index += joint.chain_index < 0 ? most_joints : given;
    const robot::Pose in_parent = robot::Pose{link.position_m, link.rotation} * in_link;
    child.position_m = in_parent.position_m;
    child.rotation = in_parent.rotation;
    child.parent = link.parent;
  }

  void remove_joints_of(int b) {
    for (std::size_t j = parts_.joints.size(); j-- > 0;) {
      if (parts_.joints[j].body != b) continue;
      const auto at = static_cast<std::ptrdiff_t>(j);
      parts_.joints.erase(parts_.joints.begin() + at);
      parts_.start_rad.erase(parts_.start_rad.begin() + at);
      parts_.model_joints.erase(parts_.model_joints.begin() + at);
      parts_.drives.erase(parts_.drives.begin() + at);
    }
  }

  void remove_body(int b) {
    parts_.bodies.erase(parts_.bodies.begin() + b);
    for (robot::Body& body : parts_.bodies) body.parent -= body.parent > b ? 1 : 0;
    for (robot::Joint& joint : parts_.joints) joint.body -= joint.body > b ? 1 : 0;
    for (robot::Geom& geom : parts_.geoms) geom.body -= geom.body > b ? 1 : 0;
  }

  static constexpr int most_joints = 1 << 20;
  ModelParts& parts_;
};

}  // namespace

std::string merge_massless_links(ModelParts& parts) {
  return LinkMerger(parts).merge();
}

}  // namespace amble::morphology
