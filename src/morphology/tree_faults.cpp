#include "amble/morphology/tree_faults.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/io/printable.hpp"

namespace amble::morphology {
namespace {

std::string file_and_line(const XmlElement& element) {
  return fmt::format("{}:{}", element.file, element.line);
}

std::string in_quotes(const std::string& name) {
  return fmt::format("'{}'", io::printable(name));
}

/// Elements by kind and name, each once.
class NamesOfKinds {
 public:
  void add(const XmlElement& element, std::string_view kind) {
    const std::string name = element.attribute_or("name", "");
    if (name.empty()) return;
    const auto [other, is_new] = first_.try_emplace({std::string(kind), name}, &element);
    if (!is_new)
      fail(ExitCode::bad_input,
           "{}: a second {} is called {}, as that of {} is: each needs a name of its own",
           file_and_line(element), kind, in_quotes(name), file_and_line(*other->second));
  }

 private:
  std::map<std::pair<std::string, std::string>, const XmlElement*> first_;
};

/// A joint of a URDF and the links that it joins.
struct UrdfJoint {
  const XmlElement* element = nullptr;
  std::string name, parent, child;
};

std::string link_of(const XmlElement& joint, const char* end) {
  const XmlElement* named = joint.child(end);
  std::string link = named == nullptr ? "" : named->attribute_or("link", "");
  if (link.empty())
    fail(ExitCode::bad_input, "{}: joint {} has no <{} link=\"…\"/>", file_and_line(joint),
         in_quotes(joint.attribute_or("name", "")), end);
  return link;
}

/// Joints by the link behind them.
std::map<std::string, UrdfJoint> joints_by_child(const XmlElement& root) {
  std::map<std::string, UrdfJoint> joints;
  std::set<std::string> links;
  for (const XmlElement& element : root.children)
    if (element.name == "link") links.insert(element.attribute_or("name", ""));
  for (const XmlElement& element : root.children) {
    if (element.name != "joint") continue;
    UrdfJoint joint{&element, element.attribute_or("name", ""), link_of(element, "parent"),
                    link_of(element, "child")};
    for (const std::string& link : {joint.parent, joint.child})
      if (!links.contains(link))
        fail(ExitCode::bad_input, "{}: joint {} names the link {}, which is not there",
             file_and_line(element), in_quotes(joint.name), in_quotes(link));
    const auto [other, is_new] = joints.try_emplace(joint.child, joint);
    if (!is_new)
      fail(ExitCode::bad_input,
           "{}: link {} is the child of two joints, {} and {} of {}: closed loops are not supported",
           file_and_line(element), in_quotes(joint.child), in_quotes(joint.name),
           in_quotes(other->second.name), file_and_line(*other->second.element));
  }
  return joints;
}

}  // namespace

void refuse_repeated_names(const XmlElement& root, bool urdf) {
  NamesOfKinds names;
  for (const XmlElement& section : root.children) {
    if (urdf && (section.name == "link" || section.name == "joint")) names.add(section, section.name);
    if (urdf || (section.name != "worldbody" && section.name != "asset")) continue;
    section.visit([&](const XmlElement& element) {
      static constexpr std::array<std::string_view, 5> kinds{"body", "joint", "geom", "site", "mesh"};
      const std::string_view kind = element.name == "freejoint" ? "joint" : std::string_view(element.name);
      if (std::ranges::find(kinds, kind) != kinds.end()) names.add(element, kind);
    });
  }
}

void refuse_odd_tree(const XmlElement& root) {
  const std::map<std::string, UrdfJoint> joints = joints_by_child(root);
  for (const auto& [start, first] : joints) {
    std::vector<std::string> links{in_quotes(start)}, by;
    const UrdfJoint* joint = &first;
    // Upwards, for as many links as there are at most.
    for (std::size_t i = 0; i < joints.size(); ++i) {
      links.push_back(in_quotes(joint->parent));
      by.push_back(in_quotes(joint->name));
      if (joint->parent == start)
        fail(ExitCode::bad_input,
             "{}: links hang on each other in a loop: {}, by the joints {}: a robot's links are a tree, with "
             "one link that no joint has as its child",
             file_and_line(*first.element), fmt::join(links, " on "), fmt::join(by, ", "));
      const auto above = joints.find(joint->parent);
      if (above == joints.end()) break;
      joint = &above->second;
    }
  }
}

}  // namespace amble::morphology
