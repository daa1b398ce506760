#include "amble/substrate/layout_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"

namespace amble::substrate {
namespace {

constexpr std::size_t most_links = 1'000'000;
/// The tick of a query for something that is no pattern.
constexpr int no_tick = -1;
/// What to do about nodes that were made for another robot's joints.
constexpr const char* other_robot = "for nodes of its own joints: --set controller.substrate=auto";

template <typename... Args>
[[noreturn]] void refuse(const std::string& key, fmt::format_string<Args...> text, Args&&... args) {
  const std::string path = "controller.substrate." + key;
  throw SettingError({path}, path + fmt::format(text, std::forward<Args>(args)...));
}

std::string item(const char* list, std::size_t index, const char* key = nullptr) {
  return key == nullptr ? fmt::format("{}[{}]", list, index) : fmt::format("{}[{}].{}", list, index, key);
}

/// Refuses an empty list, empty names and duplicates.
void check_names(const std::vector<std::string>& names, const char* key) {
  if (names.empty()) refuse(key, " is empty: expected a list of names");
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].empty()) refuse(item(key, i), " is empty: expected a name");
    if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
        names.begin() + static_cast<std::ptrdiff_t>(i))
      refuse(item(key, i), " = \"{}\" is there twice", names[i]);
  }
}

}  // namespace

void LayoutBuilder::build() {
  set_names();
  add_nodes();
  assign_joints();
  add_links();
  add_properties();
  check_properties();
  check_outputs();
  layout_.points_ = points_.points(static_cast<int>(layout_.input_names_.size()));
}

void LayoutBuilder::set_names() {
  check_names(settings_.coordinates, "coordinates");
  check_names(settings_.outputs, "outputs");
  layout_.coordinates_ = settings_.coordinates;
  layout_.output_names_ = settings_.outputs;
  layout_.expression_threshold_ = settings_.expression_threshold;
  layout_.weight_range_ = settings_.weight_range;
  layout_.pattern_ticks_ = needs_.pattern_ticks;
  layout_.properties_ = needs_.properties;
  layout_.properties_.insert(layout_.properties_.end(), needs_.neuron_properties.begin(),
                             needs_.neuron_properties.end());
  read_.resize(settings_.outputs.size());
  if (!needs_.network && !settings_.links.empty())
    refuse("links", ": a controller of kind {} has no links", needs_.kind);
  if (settings_.links.empty()) {
    layout_.input_names_ = settings_.coordinates;
  } else {
    for (const char* end : {"source", "target"})
      for (const std::string& name : settings_.coordinates)
        layout_.input_names_.push_back(fmt::format("{}.{}", end, name));
  }
  has_time_ = std::any_of(settings_.properties.begin(), settings_.properties.end(),
                          [](const PropertySettings& p) { return p.property == pattern_property; });
  if (has_time_ && needs_.time == TimeInputs::line) layout_.input_names_.push_back("time");
  if (has_time_ && needs_.time == TimeInputs::circle)
    layout_.input_names_.insert(layout_.input_names_.end(), {"time.sin", "time.cos"});
  time_inputs_ = !has_time_ ? 0 : needs_.time == TimeInputs::line ? 1 : 2;
  first_time_input_ = layout_.input_names_.size() - time_inputs_;
  for (const std::string& name : needs_.more_inputs) layout_.input_names_.push_back(name);
  for (const std::string& name : needs_.more_outputs) {
    if (std::ranges::find(layout_.output_names_, name) != layout_.output_names_.end())
      refuse("outputs", " has \"{}\", which the settings of kind {} add: leave it out", name, needs_.kind);
    layout_.output_names_.push_back(name);
  }
}

void LayoutBuilder::add_nodes() {
  if (settings_.nodes.empty()) refuse("nodes", " is empty: a controller needs nodes");
  std::map<std::string, std::size_t> names;
  std::map<std::vector<float>, std::size_t> places;
  for (std::size_t i = 0; i < settings_.nodes.size(); ++i) {
    const NodeSettings& node = settings_.nodes[i];
    check_node(i);
    if (const auto [first, is_new] = names.try_emplace(node.name, i); !is_new)
      refuse(item("nodes", i, "name"), " = \"{}\": nodes[{}] is called so, too", node.name, first->second);
    const std::vector<float> at(node.at.begin(), node.at.end());
    if (const auto [first, is_new] = places.try_emplace(at, i); !is_new)
      refuse(item("nodes", i, "at"), ": \"{}\" has the same coordinates as \"{}\" (nodes[{}])", node.name,
             settings_.nodes[first->second].name, first->second);
    Node& added = layout_.nodes_.emplace_back(Node{node.name, node.group, node.at, std::nullopt, -1});
    if (!node.sensor.empty())
      added.sensor = parse_sensor(node.sensor, robot_, "controller.substrate." + item("nodes", i, "sensor"));
  }
  check_groups();
}

void LayoutBuilder::check_groups() const {
  std::map<std::string, std::size_t> names;
  for (std::size_t i = 0; i < settings_.nodes.size(); ++i) names.try_emplace(settings_.nodes[i].name, i);
  for (std::size_t i = 0; i < settings_.nodes.size(); ++i) {
    const auto namesake = names.find(settings_.nodes[i].group);
    if (namesake != names.end() && namesake->second != i)
      refuse(item("nodes", i, "group"), " = \"{}\": nodes[{}], which is another node, is called so",
             settings_.nodes[i].group, namesake->second);
  }
}

void LayoutBuilder::check_node(std::size_t index) const {
  const NodeSettings& node = settings_.nodes[index];
  if (node.name.empty()) refuse(item("nodes", index, "name"), " is missing");
  if (node.at.size() != settings_.coordinates.size())
    refuse(item("nodes", index, "at"), ": \"{}\" has {} coordinates: expected {} ({})", node.name,
           node.at.size(), settings_.coordinates.size(), fmt::join(settings_.coordinates, ", "));
  if (!node.sensor.empty() && !node.joint.empty())
    refuse(item("nodes", index), ": \"{}\" has both a sensor and a joint", node.name);
  if (!needs_.network && node.joint.empty())
    refuse(item("nodes", index), ": \"{}\" drives no joint: each node of a controller of kind {} must",
           node.name, needs_.kind);
}

void LayoutBuilder::assign_joints() {
  layout_.drivers_.assign(robot_.joints.size(), -1);
  for (std::size_t i = 0; i < settings_.nodes.size(); ++i) {
    const std::string& name = settings_.nodes[i].joint;
    if (name.empty()) continue;
    const auto joint = std::find_if(robot_.joints.begin(), robot_.joints.end(),
                                    [&](const robot::Joint& j) { return j.name == name; });
    if (joint == robot_.joints.end())
      refuse(item("nodes", i, "joint"), " = \"{}\": the robot has no such joint; {}", name, other_robot);
    if (!joint->driven())
      refuse(item("nodes", i, "joint"), " = \"{}\": the robot's file has that joint held, not driven", name);
    layout_.nodes_[i].joint = static_cast<int>(joint - robot_.joints.begin());
    int& driver = layout_.drivers_[to_index(layout_.nodes_[i].joint)];
    if (driver >= 0)
      refuse(item("nodes", i, "joint"), " = \"{}\": \"{}\" (nodes[{}]) drives it already", name,
             name_of(driver), driver);
    driver = static_cast<int>(i);
  }
  for (std::size_t joint = 0; joint < robot_.joints.size(); ++joint)
    if (layout_.drivers_[joint] < 0 && robot_.joints[joint].driven())
      refuse("nodes", ": no node drives the robot's joint {}; {}", robot_.joints[joint].name, other_robot);
}

void LayoutBuilder::add_links() {
  for (std::size_t i = 0; i < settings_.links.size(); ++i) {
    const LinkSettings& link = settings_.links[i];
    const auto from = nodes_of(link.from, item("links", i, "from"));
    const auto to = nodes_of(link.to, item("links", i, "to"));
    const auto same = coordinates_of(link.same, item("links", i, "same"));
    const int output = output_of(link.weight, item("links", i, "weight"));
    const bool itself = link.from == link.to && is_node(link.from);
    const std::size_t before = layout_.links_.size();
    for (const int source : from) {
      const auto& at = layout_.nodes_[to_index(source)].at;
      for (const int target : to) {
        const auto& other = layout_.nodes_[to_index(target)].at;
        const bool agree =
            std::all_of(same.begin(), same.end(), [&](std::size_t c) { return at[c] == other[c]; });
        if (!agree || (source == target && !itself)) continue;
        add_link(i, source, target, output);
        if (link.both_ways) add_link(i, target, source, output);
      }
    }
    if (layout_.links_.size() == before)
      refuse(item("links", i), ": there is nothing to link from \"{}\" to \"{}\"", link.from, link.to);
  }
}

void LayoutBuilder::add_link(std::size_t index, int source, int target, int output) {
  const Port port = settings_.links[index].port;
  check_port(index, source, target);
  if (const auto [first, is_new] = linked_.try_emplace({source, target, port}, index); !is_new)
    refuse(item("links", index), ": \"{}\" is linked to \"{}\" already by links[{}]", name_of(source),
           name_of(target), first->second);
  if (layout_.links_.size() == most_links) refuse("links", " are more than {}", most_links);
  double factor = 1.0;
  if (const std::string& times = settings_.links[index].times; !times.empty())
    factor =
        layout_.nodes_[to_index(target)].at[coordinates_of({times}, item("links", index, "times")).front()];
  layout_.links_.push_back({source, target, output, port, factor});
  layout_.link_points_.push_back(points_.add(link_inputs(source, target)));
}

/// Sensors and neurons act on neurons and SUPGs, SUPGs on neurons and on other SUPGs' phases.
void LayoutBuilder::check_port(std::size_t index, int source, int target) const {
  const Port port = settings_.links[index].port;
  const std::string key = item("links", index, "port");
  const std::string_view name = port_names[to_index(static_cast<int>(port))];
  if (!has_ports()) {
    if (port != Port::hidden)
      refuse(key, " = \"{}\": links of a controller of kind {} have no ports: expected hidden", name,
             needs_.kind);
    return;
  }
  const Node &from = layout_.nodes_[to_index(source)], &to = layout_.nodes_[to_index(target)];
  if (to.sensor) refuse(item("links", index, "to"), ": \"{}\" is a sensor", to.name);
  const bool to_supg = to.joint >= 0, from_supg = from.joint >= 0;
  if (to_supg != (port != Port::hidden))
    refuse(key, " = \"{}\": \"{}\" is a {}: expected {}", name, to.name, to_supg ? "SUPG" : "neuron",
           to_supg ? "rate, amplitude, shift or coupling" : "hidden");
  if (to_supg && from_supg != (port == Port::coupling))
    refuse(key, " = \"{}\": \"{}\" is a {}: expected {}", name, from.name,
           from_supg ? "SUPG" : "sensor or a neuron", from_supg ? "coupling" : "rate, amplitude or shift");
}

const std::vector<std::string>& LayoutBuilder::needed(int node) const {
  return has_ports() && layout_.nodes_[to_index(node)].joint < 0 ? needs_.neuron_properties
                                                                 : needs_.properties;
}

void LayoutBuilder::add_properties() {
  for (std::size_t i = 0; i < settings_.properties.size(); ++i) {
    const PropertySettings& property = settings_.properties[i];
    if (std::ranges::count(layout_.properties_, property.property) == 0)
      refuse(item("properties", i, "property"),
             " = \"{}\": nodes of a controller of kind {} have no such property{}{}", property.property,
             needs_.kind, layout_.properties_.empty() ? "" : ": expected ",
             fmt::join(layout_.properties_, " or "));
    if (property.property == pattern_property && property.output.empty())
      refuse(item("properties", i, "output"), " is missing: a pattern is not constant");
    for (const int node : nodes_of(property.of, item("properties", i, "of"))) add_property(i, node);
  }
}

void LayoutBuilder::add_property(std::size_t index, int node) {
  const PropertySettings& property = settings_.properties[index];
  const std::string& what = property.property;
  const int index_of_property = layout_.property_index(what);
  if (layout_.nodes_[to_index(node)].sensor)
    refuse(item("properties", index, "of"), ": \"{}\" is a sensor and has no {}", name_of(node), what);
  if (std::ranges::count(needed(node), what) == 0)
    refuse(item("properties", index, "of"), ": \"{}\" {} a joint and has no {}: expected {}", name_of(node),
           layout_.nodes_[to_index(node)].joint >= 0 ? "drives" : "does not drive", what,
           fmt::join(needed(node), " or "));
  for (const Layout::Source& other : layout_.sources_)
    if (other.node == node && other.property == index_of_property)
      refuse(item("properties", index), ": the {} of \"{}\" is given already", what, name_of(node));

  Layout::Source& source = layout_.sources_.emplace_back();
  source.node = node;
  source.property = index_of_property;
  source.pattern = what == pattern_property;
  source.low = property.low;
  source.high = property.high;
  source.value = property.value;
  const auto zero = coordinates_of(property.zero, item("properties", index, "zero"));
  if (property.output.empty()) return;
  source.output = output_of(property.output, item("properties", index, "output"));
  const int last_tick = source.pattern ? needs_.pattern_ticks : 0;
  for (int tick = 0; tick <= last_tick; ++tick)
    source.points.push_back(points_.add(node_inputs(node, zero, source.pattern ? tick : no_tick)));
}

void LayoutBuilder::check_properties() const {
  for (const std::string& property : layout_.properties_) {
    std::vector<bool> has(layout_.nodes_.size());
    for (const Layout::Source& source : layout_.sources_)
      if (source.property == layout_.property_index(property)) has[to_index(source.node)] = true;
    for (std::size_t node = 0; node < has.size(); ++node)
      if (!has[node] && !layout_.nodes_[node].sensor &&
          std::ranges::count(needed(static_cast<int>(node)), property) > 0)
        refuse("properties", ": \"{}\" has no {}, which a controller of kind {} needs",
               layout_.nodes_[node].name, property, needs_.kind);
  }
}

void LayoutBuilder::check_outputs() const {
  for (std::size_t i = 0; i < read_.size(); ++i)
    if (!read_[i])
      refuse(item("outputs", i), " = \"{}\": no link and no property reads it", settings_.outputs[i]);
}

bool LayoutBuilder::is_node(const std::string& name) const {
  return std::any_of(layout_.nodes_.begin(), layout_.nodes_.end(),
                     [&](const Node& node) { return node.name == name; });
}

std::vector<int> LayoutBuilder::nodes_of(const std::string& name, const std::string& key) const {
  std::vector<int> found;
  for (std::size_t i = 0; i < layout_.nodes_.size(); ++i)
    if (!name.empty() && (layout_.nodes_[i].name == name || layout_.nodes_[i].group == name))
      found.push_back(static_cast<int>(i));
  if (found.empty()) refuse(key, " = \"{}\": there is no node and no group of that name", name);
  return found;
}

int LayoutBuilder::output_of(const std::string& name, const std::string& key) {
  const auto found = std::find(settings_.outputs.begin(), settings_.outputs.end(), name);
  if (found == settings_.outputs.end())
    refuse(key, " = \"{}\": the CPPN has no such output (it has {})", name,
           fmt::join(settings_.outputs, ", "));
  const auto output = found - settings_.outputs.begin();
  read_[to_index(output)] = true;
  return static_cast<int>(output);
}

std::vector<std::size_t> LayoutBuilder::coordinates_of(const std::vector<std::string>& names,
                                                       const std::string& key) const {
  std::vector<std::size_t> found;
  for (const std::string& name : names) {
    const auto at = std::find(settings_.coordinates.begin(), settings_.coordinates.end(), name);
    if (at == settings_.coordinates.end())
      refuse(key, ": there is no coordinate \"{}\" (there are {})", name,
             fmt::join(settings_.coordinates, ", "));
    found.push_back(to_index(at - settings_.coordinates.begin()));
  }
  return found;
}

std::vector<float> LayoutBuilder::coordinates(int node) const {
  const auto& at = layout_.nodes_[to_index(node)].at;
  return {at.begin(), at.end()};
}

std::vector<float> LayoutBuilder::link_inputs(int source, int target) const {
  std::vector<float> inputs = coordinates(source);
  const std::vector<float> end = coordinates(target);
  inputs.insert(inputs.end(), end.begin(), end.end());
  inputs.resize(layout_.input_names_.size());
  return inputs;
}

std::vector<float> LayoutBuilder::node_inputs(int node, const std::vector<std::size_t>& zero,
                                              int tick) const {
  std::vector<float> inputs = coordinates(node);
  for (const std::size_t coordinate : zero) inputs[coordinate] = 0.0f;
  inputs.resize(layout_.input_names_.size());
  if (has_time_ && tick != no_tick)
    set_time_inputs(needs_.time, tick, needs_.pattern_ticks,
                    std::span(inputs).subspan(first_time_input_, time_inputs_));
  return inputs;
}

}  // namespace amble::substrate
