#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "amble/controllers/automatic.hpp"
#include "amble/controllers/automatic_legs.hpp"
#include "amble/controllers/ctrnn.hpp"
#include "amble/controllers/supg.hpp"
#include "amble/core/index.hpp"

namespace amble::controllers {
namespace {

using substrate::Port;

/// Groups of nodes.
constexpr const char *of_stop = "stop", *of_speed = "speed", *of_turn = "turn", *of_feet = "touch",
                     *neurons = "hidden", *first_supg = "lead", *other_supg = "supg";
constexpr std::array root_sensors{"command_stop", "command_speed", "command_turn", "heading_error",
                                  "yaw_rate"};

/// 1 on the left, −1 on the right, 0 where the two cannot be told.
double side_of(const AutomaticLegs& legs, int leg) {
  if (legs.pairs().empty()) return 0.0;
  for (const robot::LegPair& pair : legs.pairs())
    if (pair.left == leg) return 1.0;
  return legs.is_right(leg) ? -1.0 : 0.0;
}

void add_mixed_nodes(const AutomaticLegs& legs, const substrate::Settings& supgs,
                     substrate::Settings& settings) {
  const auto add = [&](const std::string& name, const char* group, std::vector<double> at) {
    auto& node = settings.nodes.emplace_back();
    node.name = name;
    node.group = group;
    node.at = std::move(at);
    return &node;
  };
  const int count = static_cast<int>(root_sensors.size());
  for (int i = 0; i < count; ++i) {
    const std::string sensor = root_sensors[to_index(i)];
    add(sensor,
        i == 0   ? of_stop
        : i == 1 ? of_speed
                 : of_turn,
        {0.0, evenly_spread(i, count), 0.0, -1.0})
        ->sensor = sensor;
  }
  std::size_t next = 0;
  for (int leg = 0; leg < legs.count(); ++leg) {
    const auto motors = legs.motors(leg);
    const double side = side_of(legs, leg);
    // Where SUPGs alone have the leg.
    const double place = motors.empty() ? evenly_spread(leg, legs.count()) : supgs.nodes[next].at[0];
    const std::string sensor = "touch." + legs.name(leg);
    add(legs.name(leg) + ".touch", of_feet, {place, 0.0, side, -0.5})->sensor = sensor;
    add(legs.name(leg) + ".hidden 1", neurons, {place, -1.0, side, 0.0});
    add(legs.name(leg) + ".hidden 2", neurons, {place, 1.0, side, 0.0});
    for (std::size_t m = 0; m < motors.size(); ++m, ++next)
      add(motors[m].node, m == 0 ? first_supg : other_supg, {place, supgs.nodes[next].at[1], side, 1.0})
          ->joint = motors[m].joint;
  }
}

/// What acts on SUPGs does so by CPPN outputs of its own, so that one weight of a CPPN is enough to steer;
/// what tells left from right acts on the two sides in opposite senses.
void add_mixed_links(bool has_sides, bool has_others, int legs, substrate::Settings& settings) {
  const auto link = [&](const char* from, const char* to, Port port, const std::string& output,
                        bool by_side = false) {
    settings.links.push_back({.from = from,
                              .to = to,
                              .weight = output,
                              .same = {},
                              .port = port,
                              .times = by_side && has_sides ? "side" : ""});
  };
  for (const char* from : {of_stop, of_speed, of_turn, of_feet}) link(from, neurons, Port::hidden, "hidden");
  if (legs > 0) link(neurons, neurons, Port::hidden, "hidden");
  const auto shape = [&](const char* from, Port port, const std::string& output) {
    link(from, first_supg, port, output, from == of_turn);
    if (has_others && port != Port::rate) link(from, other_supg, port, output, from == of_turn);
  };
  shape(of_stop, Port::amplitude, "stop_amplitude");
  for (const auto& [from, prefix] : {std::pair(of_speed, "speed_"), {of_turn, "turn_"}, {neurons, ""}})
    for (const Port port : {Port::rate, Port::amplitude, Port::shift})
      shape(from, port, prefix + std::string(substrate::port_names[to_index(static_cast<int>(port))]));
  if (legs > 1) link(first_supg, first_supg, Port::coupling, "coupling");
}

}  // namespace

substrate::Settings automatic_mixed(const robot::RobotSpec& robot) {
  const AutomaticLegs legs(robot);
  const substrate::Settings supgs = automatic_supg(robot);
  substrate::Settings settings;
  settings.coordinates = {"leg", "joint_type", "side", "layer"};
  settings.outputs = {"pattern",        "offset",    "hidden",         "rate",
                      "amplitude",      "shift",     "speed_rate",     "speed_amplitude",
                      "speed_shift",    "turn_rate", "turn_amplitude", "turn_shift",
                      "stop_amplitude", "coupling",  "bias",           "time_constant"};
  add_mixed_nodes(legs, supgs, settings);
  int leads = 0;
  bool has_others = false;
  for (const auto& node : settings.nodes) {
    leads += node.group == first_supg ? 1 : 0;
    has_others = has_others || node.group == other_supg;
  }
  add_mixed_links(!legs.pairs().empty(), has_others, std::min(leads, legs.count()), settings);
  if (leads < 2) std::erase(settings.outputs, "coupling");
  const auto add = [&](const char* of, std::string_view property, double low, double high) {
    auto& added = settings.properties.emplace_back();
    added.of = of;
    added.property = added.output = property;
    added.low = low;
    added.high = high;
    return &added;
  };
  for (const char* of : {first_supg, other_supg}) {
    if (of == other_supg && !has_others) continue;
    // As SUPGs alone: patterns by leg and joint type, offsets by leg.
    add(of, substrate::pattern_property, -1.0, 1.0)->zero = {"side", "layer"};
    add(of, offset_property, -1.0, 1.0)->zero = {"joint_type", "side", "layer"};
  }
  add(neurons, bias_property, -1.0, 1.0);
  add(neurons, time_constant_property, 0.05, 0.55);
  return settings;
}

}  // namespace amble::controllers
