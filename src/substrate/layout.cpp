#include "amble/substrate/layout.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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
    float* const values = source.pattern
                              ? decoded.patterns.data() + node * ticks
                              : decoded.properties[to_index(source.property)].by_node.data() + node;
    for (std::size_t i = 0; i < (source.pattern ? ticks : 1); ++i)
      values[i] = static_cast<float>(
          source.output < 0
              ? source.value
              : interpolated(source.low, source.high, output_at(results, source.output, source.points[i])));
  }
}

}  // namespace amble::substrate
