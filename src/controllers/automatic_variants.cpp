#include "amble/controllers/automatic_variants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "amble/controllers/automatic_legs.hpp"
#include "amble/controllers/ctrnn.hpp"
#include "amble/controllers/joint_type.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/substrate/sensor.hpp"

namespace amble::controllers {
namespace {

using substrate::SensorKind;
using substrate::SensorOwner;

constexpr double sense_y = -2.0;

std::string expected_senses() {
  std::string text;
  for (const SensorKind& kind : substrate::sensor_kinds()) {
    if (kind.owner == SensorOwner::clock || kind.kind == substrate::Sensor::Kind::touch) continue;
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", kind.name,
                        kind.owner == SensorOwner::joint ? ".TYPE" : "");
  }
  return text;
}

bool tells_sides(std::string_view sensor) {
  constexpr std::array<std::string_view, 5> sided{"roll", "yaw", "yaw_rate", "command_turn", "heading_error"};
  return std::ranges::find(sided, sensor) != sided.end();
}

/// What a node of this leg's module senses; nothing where the leg lacks the joint.
std::optional<std::string> sensor_of(const robot::RobotSpec& robot, const robot::Leg& leg,
                                     const std::string& name, const std::string& key) {
  const std::size_t dot = name.find('.');
  const auto kinds = substrate::sensor_kinds();
  const auto kind = std::ranges::find(kinds, std::string_view(name).substr(0, dot), &SensorKind::name);
  const bool typed = kind != kinds.end() && kind->owner == SensorOwner::joint;
  if (kind == kinds.end() || kind->owner == SensorOwner::clock ||
      kind->kind == substrate::Sensor::Kind::touch || typed != (dot != std::string::npos))
    fail_setting({key}, "{} = \"{}\": expected {}; modules sense touch already", key, name,
                 expected_senses());
  if (kind->owner == SensorOwner::leg) return name + "." + leg.name;
  if (!typed) return name;
  const int joint = leg.joints[joint_type_index(robot, name.substr(dot + 1), key, name)];
  if (joint < 0) return std::nullopt;
  return name.substr(0, dot + 1) + robot.joints[to_index(joint)].name;
}

bool has_group(const substrate::Settings& made, std::string_view group) {
  return std::ranges::find(made.nodes, group, &substrate::NodeSettings::group) != made.nodes.end();
}

/// Where a leg's module is: module_x and module_y of its touch sensor.
std::vector<double> module_of(const substrate::Settings& made, const std::string& leg) {
  const auto touch = std::ranges::find(made.nodes, leg + ".touch", &substrate::NodeSettings::name);
  return {touch->at[2], touch->at[3]};
}

void link_senses(bool has_sides, substrate::Settings& made) {
  for (const char* const from : {sense_group, turn_group}) {
    if (!has_group(made, from)) continue;
    made.outputs.emplace_back(from);
    for (const char* const to : {"hidden", "outer motor", "middle motor"})
      if (has_group(made, to))
        made.links.push_back({.from = from,
                              .to = to,
                              .weight = from,
                              .same = {"module_x", "module_y"},
                              .times = from == turn_group && has_sides ? "module_x" : ""});
  }
}

}  // namespace

void add_module_senses(const robot::RobotSpec& robot, const std::vector<std::string>& sensors,
                       substrate::Settings& made) {
  const int count = static_cast<int>(sensors.size());
  bool has_sides = false;
  for (const robot::Leg& leg : robot.legs) {
    const std::vector<double> module = module_of(made, leg.name);
    has_sides = has_sides || module[0] != 0.0;
    for (int i = 0; i < count; ++i) {
      const std::string& name = sensors[to_index(i)];
      const std::string key = fmt::format("controller.ctrnn.sensors[{}]", i);
      if (std::find(sensors.begin(), sensors.begin() + i, name) != sensors.begin() + i)
        fail_setting({key}, "{} = \"{}\" is there twice", key, name);
      const auto sensor = sensor_of(robot, leg, name, key);
      if (!sensor) continue;
      auto& node = made.nodes.emplace_back();
      node.name = leg.name + "." + name;
      node.group = tells_sides(name) ? turn_group : sense_group;
      node.at = {evenly_spread(i, count), sense_y, module[0], module[1]};
      node.sensor = *sensor;
    }
  }
  link_senses(has_sides, made);
}

bool has_constant_bias(const substrate::PropertySettings& item) {
  return item.property == bias_property && item.output.empty();
}

void evolve_motor_biases(substrate::Settings& made) {
  constexpr double most = 3.0;
  for (substrate::PropertySettings& item : made.properties)
    if (has_constant_bias(item)) {
      item.output = bias_property;
      item.low = -most;
      item.high = most;
      item.value = substrate::PropertySettings().value;
    }
}

bool is_leg_neuron(const substrate::NodeSettings& node) {
  return node.group == leg_neurons;
}

void remove_neurons(substrate::Settings& made) {
  constexpr std::string_view neurons = leg_neurons, feet = "touch";
  const auto is_gone = [&](std::string_view group) { return group == neurons || group == feet; };
  std::erase_if(made.nodes, [&](const substrate::NodeSettings& node) { return is_gone(node.group); });
  std::erase_if(made.properties, [&](const substrate::PropertySettings& item) { return is_gone(item.of); });
  std::erase_if(made.links,
                [&](const substrate::LinkSettings& link) { return is_gone(link.from) || is_gone(link.to); });
  // An output that nothing reads is refused.
  std::erase_if(made.outputs, [&](const std::string& output) {
    return std::ranges::find(made.links, output, &substrate::LinkSettings::weight) == made.links.end() &&
           std::ranges::find(made.properties, output, &substrate::PropertySettings::output) ==
               made.properties.end();
  });
}

}  // namespace amble::controllers
