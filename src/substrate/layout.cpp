#include "amble/substrate/layout.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/cppn/activation.hpp"
#include "amble/substrate/layout_builder.hpp"

namespace amble::substrate {
namespace {

/// Linear interpolation: `low` at o = −1, `high` at o = 1, o clamped to that range.
double interpolated(double low, double high, float o) {
  return 0.5 * (low + high) + 0.5 * (high - low) * std::clamp(static_cast<double>(o), -1.0, 1.0);
}

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

void set_time_inputs(TimeInputs time, int tick, int pattern_ticks, std::span<float> inputs) {
  if (time == TimeInputs::line) {
    inputs[0] = static_cast<float>(static_cast<double>(tick) / pattern_ticks);
    return;
  }
  // The CPPN's own sine, sin 2x, is the same on every CPU.
  const double turns = static_cast<double>(tick % pattern_ticks) / pattern_ticks;
  inputs[0] = static_cast<float>(std::numbers::pi * turns);
  inputs[1] = static_cast<float>(std::numbers::pi * (turns + 0.25));
  cppn::activate(neat::Activation::sine, cppn::Linear::identity, inputs);
}

Layout::Layout(const Settings& settings, const Needs& needs, const robot::RobotSpec& robot) {
  LayoutBuilder(*this, settings, needs, robot).build();
}

std::span<const float> Decoded::of(std::string_view property) const {
  const auto found = std::ranges::find(properties, property, &Values::property);
  AMBLE_CHECK(found != properties.end(), "a property that the controller needs");
  return found->by_node;
}

int Layout::property_index(std::string_view property) const {
  const auto found = std::ranges::find(properties_, property);
  AMBLE_CHECK(found != properties_.end(), "a property that the controller needs");
  return static_cast<int>(found - properties_.begin());
}

const Layout::Source& Layout::source(std::string_view property, int node) const {
  const int index = property_index(property);
  const auto found = std::ranges::find_if(
      sources_, [&](const Source& source) { return source.property == index && source.node == node; });
  AMBLE_CHECK(found != sources_.end(), "the node lacks this property");
  return *found;
}

bool Layout::shared(std::string_view property, int a, int b) const {
  const Source &one = source(property, a), &other = source(property, b);
  if (one.output != other.output) return false;
  if (one.output < 0) return one.value == other.value;
  return one.points == other.points && one.low == other.low && one.high == other.high;
}

double Layout::lowest(std::string_view property) const {
  double lowest = INFINITY;
  for (const Source& source : sources_)
    if (source.property == property_index(property))
      lowest = std::min(lowest, source.output < 0 ? source.value : std::min(source.low, source.high));
  return lowest;
}

Decoded Layout::decode(const cppn::Network& network) const {
  AMBLE_CHECK(network.outputs() == static_cast<int>(output_names_.size()),
              "the CPPN has another number of outputs than the substrate");
  std::vector<float> results(output_names_.size() * to_index(points_.capacity()));
  network.evaluate(points_, results);
  Decoded decoded;
  decode_weights(results, decoded);
  decode_properties(results, decoded);
  return decoded;
}

float Layout::output_at(std::span<const float> results, int output, int point) const {
  return results[to_index(output * points_.capacity() + point)];
}

void Layout::decode_weights(std::span<const float> results, Decoded& decoded) const {
  decoded.weights.resize(links_.size());
  for (std::size_t i = 0; i < links_.size(); ++i) {
    // sign(o) (|o| − t) / (1 − t) × weight_range, or 0.
    const double o = interpolated(-1.0, 1.0, output_at(results, links_[i].output, link_points_[i]));
    const double excess = (std::fabs(o) - expression_threshold_) / (1.0 - expression_threshold_);
    if (excess > 0.0)
      decoded.weights[i] = static_cast<float>(std::copysign(excess * weight_range_, o) * links_[i].factor);
  }
}

void Layout::decode_properties(std::span<const float> results, Decoded& decoded) const {
  for (const std::string& property : properties_) {
    const std::size_t numbers = property == pattern_property ? 0 : nodes_.size();
    decoded.properties.push_back({property, std::vector<float>(numbers)});
  }
  const std::size_t ticks = to_index(pattern_ticks_ + 1);
  if (pattern_ticks_ > 0) decoded.patterns.resize(nodes_.size() * ticks);
  for (const Source& source : sources_) {
    const std::size_t node = to_index(source.node);
    decode_source(source, results,
                  source.pattern ? decoded.patterns.data() + node * ticks
                                 : decoded.properties[to_index(source.property)].by_node.data() + node);
  }
}

void Layout::decode_source(const Source& source, std::span<const float> results, float* values) const {
  for (std::size_t i = 0; i < (source.pattern ? to_index(pattern_ticks_ + 1) : 1); ++i)
    values[i] = static_cast<float>(
        source.output < 0
            ? source.value
            : interpolated(source.low, source.high, output_at(results, source.output, source.points[i])));
}

std::vector<float> Layout::patterns(const cppn::Network& network, std::span<const float> more_inputs) const {
  cppn::Points points = points_;
  const int first = points.inputs() - static_cast<int>(more_inputs.size());
  for (int point = 0; point < points.count(); ++point)
    for (std::size_t i = 0; i < more_inputs.size(); ++i)
      points.set(point, first + static_cast<int>(i), more_inputs[i]);
  std::vector<float> results(output_names_.size() * to_index(points.capacity()));
  network.evaluate(points, results);
  const std::size_t ticks = to_index(pattern_ticks_ + 1);
  std::vector<float> patterns(nodes_.size() * ticks);
  for (const Source& source : sources_)
    if (source.pattern) decode_source(source, results, patterns.data() + to_index(source.node) * ticks);
  return patterns;
}

std::string summary(const Settings& settings, const Layout& layout) {
  return fmt::format("CPPN inputs   {}\nCPPN outputs  {}\n", fmt::join(layout.input_names(), ", "),
                     fmt::join(layout.output_names(), ", ")) +
         nodes_text(settings) + properties_text(settings) + links_text(layout);
}

}  // namespace amble::substrate
