#include "amble/morphology/mjcf_defaults.hpp"

#include <algorithm>
#include <array>

namespace amble::morphology {

MjcfDefaults::MjcfDefaults(const XmlElement& root) {
  for (const XmlElement& child : root.children) {
    if (child.name != "default") continue;
    tops_.push_back({&child, tops_.empty() ? nullptr : &tops_.back()});
    top_names_.insert(child.attribute_or("class", "main"));
    add_within(child, tops_.back());
  }
}

namespace {

/// Whether defaults of one are those of the other: actuators of a class share theirs.
bool share_defaults(std::string_view a, std::string_view b) {
  constexpr std::array<std::string_view, 9> actuators{
      "general", "motor", "position", "velocity", "intvelocity", "damper", "cylinder", "muscle", "adhesion"};
  const auto is_actuator = [&](std::string_view name) {
    return std::ranges::find(actuators, name) != actuators.end();
  };
  return a == b || (is_actuator(a) && is_actuator(b));
}

}  // namespace

std::optional<std::string> MjcfDefaults::attribute(const XmlElement& element, std::string_view key,
                                                   const std::string& childclass) const {
  if (auto own = element.attribute(key)) return own;
  for (const Class* at = find(element.attribute_or("class", childclass)); at != nullptr; at = at->parent) {
    const auto& settings = at->settings->children;
    for (auto its = settings.rbegin(); its != settings.rend(); ++its)
      if (share_defaults(its->name, element.name))
        if (auto value = its->attribute(key)) return value;
  }
  return std::nullopt;
}

const MjcfDefaults::Class* MjcfDefaults::find(const std::string& name) const {
  if (name.empty() || top_names_.contains(name)) return tops_.empty() ? nullptr : &tops_.back();
  const auto found = classes_.find(name);
  return found == classes_.end() ? nullptr : &found->second;
}

void MjcfDefaults::add_within(const XmlElement& element, const Class& parent) {
  for (const XmlElement& child : element.children) {
    const auto name = child.attribute("class");
    if (child.name != "default" || !name) continue;
    const auto [added, is_new] = classes_.try_emplace(*name, Class{&child, &parent});
    if (is_new) add_within(child, added->second);
  }
}

}  // namespace amble::morphology
