#include "amble/substrate/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "amble/core/index.hpp"

namespace amble::substrate {
namespace {

const std::string& group_or_name(const Node& node) {
  return node.group.empty() ? node.name : node.group;
}

template <typename Texts, typename Text>
std::size_t widest(const Texts& texts, Text text) {
  std::size_t width = 0;
  for (const auto& item : texts) width = std::max(width, text(item).size());
  return width;
}

std::string nodes_text(const Settings& settings) {
  const auto name_width = widest(settings.nodes, [](const NodeSettings& n) { return n.name; });
  const auto group_width = widest(settings.nodes, [](const NodeSettings& n) { return n.group; });
  std::string text =
      fmt::format("\n{} nodes ({})\n", settings.nodes.size(), fmt::join(settings.coordinates, ", "));
  for (const NodeSettings& node : settings.nodes) {
    const std::string role = !node.sensor.empty()  ? "  senses " + node.sensor
                             : !node.joint.empty() ? "  drives " + node.joint
                                                   : std::string();
    text += fmt::format("  {:{}}  {:{}}  ({}){}\n", node.name, name_width, node.group, group_width,
                        fmt::join(node.at, ", "), role);
  }
  return text;
}

std::string properties_text(const Settings& settings) {
  if (settings.properties.empty()) return {};
  std::string text = "\nproperties\n";
  for (const PropertySettings& property : settings.properties) {
    text += fmt::format("  {} of {}: ", property.property, property.of);
    if (property.output.empty()) {
      text += fmt::format("{}\n", property.value);
      continue;
    }
    text += fmt::format("{} to {} by output {}", property.low, property.high, property.output);
    text +=
        property.zero.empty() ? "\n" : fmt::format(", queried with {} = 0\n", fmt::join(property.zero, ", "));
  }
  return text;
}

std::string links_text(const Layout& layout) {
  const auto& nodes = layout.nodes();
  const auto node = [&](int index) -> const Node& { return nodes[to_index(index)]; };
  std::map<std::tuple<std::string, std::string, std::string>, int> counts;
  for (const Link& link : layout.links())
    ++counts[{group_or_name(node(link.source)), group_or_name(node(link.target)),
              layout.output_names()[to_index(link.output)]}];
  std::string text = fmt::format("\n{} links\n", layout.links().size());
  for (const auto& [groups, count] : counts)
    text += fmt::format("  {:5}  {} -> {}, by output {}\n", count, std::get<0>(groups), std::get<1>(groups),
                        std::get<2>(groups));
  if (!layout.links().empty()) text += "\nlink by link\n";
  const auto width = widest(nodes, [](const Node& n) { return n.name; });
  for (const Link& link : layout.links())
    text += fmt::format("  {:{}}  ->  {:{}}  {}\n", node(link.source).name, width, node(link.target).name,
                        width, layout.output_names()[to_index(link.output)]);
  return text;
}

}  // namespace

std::string summary(const Settings& settings, const Layout& layout) {
  return fmt::format("CPPN inputs   {}\nCPPN outputs  {}\n", fmt::join(layout.input_names(), ", "),
                     fmt::join(layout.output_names(), ", ")) +
         nodes_text(settings) + properties_text(settings) + links_text(layout);
}

}  // namespace amble::substrate
