#include "amble/controllers/automatic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "amble/controllers/automatic_legs.hpp"
#include "amble/controllers/ctrnn.hpp"
#include "amble/controllers/supg.hpp"
#include "amble/core/index.hpp"

namespace amble::controllers {
namespace {

/// The authors' code has the four legs at ±1 and ±0.33, divided by 50: thirds to two decimals.
double supg_leg(int leg, int legs) {
  constexpr double divisor = 50.0;
  const double spread = legs < 2 ? 0.0 : 2.0 * leg / (legs - 1.0) - 1.0;
  // Two decimals tell up to 100 legs apart.
  return legs > 100 ? spread / divisor : std::round(spread * 100.0) / (100.0 * divisor) + 0.0;
}

/// Rows of n legs at i/(n/2): −1, −0.5, 0.5, 1 for four of them.
double network_row(int leg, int legs) {
  const int half = legs / 2;
  if (half == 0) return 0.0;
  int step = leg - half;
  if (legs % 2 == 0 && step >= 0) ++step;
  return std::round(1e4 * step / half) / 1e4 + 0.0;
}

constexpr std::array body_sensors{"pitch", "roll", "yaw", "sine"};

/// The places of the sine wave architecture's nodes.
class Planes {
 public:
  explicit Planes(const AutomaticLegs& legs)
      : legs_(legs),
        columns_(legs.types() + 1 +
                 (static_cast<int>(body_sensors.size()) + legs.count() - 1) / std::max(legs.count(), 1)) {}

  int columns() const { return columns_; }
  std::vector<double> at(int layer, int leg, int column) const {
    return {static_cast<double>(layer), network_row(leg, legs_.count()), evenly_spread(column, columns_)};
  }

 private:
  const AutomaticLegs& legs_;
  int columns_;
};

void add_network_inputs(const AutomaticLegs& legs, const Planes& planes, substrate::Settings& settings) {
  const auto add = [&](const std::string& name, const std::string& sensor, int leg, int column) {
    settings.nodes.push_back(
        {.name = name, .group = "input", .at = planes.at(-1, leg, column), .sensor = sensor, .joint = {}});
  };
  for (int leg = 0; leg < legs.count(); ++leg) {
    std::vector<LegMotor> motors = legs.motors(leg);
    const auto place = [&](const LegMotor& motor) { return legs.place_across(motor.type, true); };
    std::ranges::sort(motors, {}, place);
    for (const LegMotor& motor : motors)
      add(motor.node + " angle", "angle." + motor.joint, leg, place(motor));
    add(legs.name(leg) + ".touch", "touch." + legs.name(leg), leg, legs.types());
    for (int i = leg; i < static_cast<int>(body_sensors.size()); i += legs.count())
      add(body_sensors[to_index(i)], body_sensors[to_index(i)], leg, legs.types() + 1 + i / legs.count());
  }
}

constexpr const char *touch = "touch", *hidden = "hidden", *outer = "outer motor", *middle = "middle motor";

/// Modules, one per leg, and what links them.
class Modules {
 public:
  explicit Modules(const robot::RobotSpec& robot) : legs_(robot) {
    settings_.coordinates = {"x", "y", "module_x", "module_y"};
    for (int leg = 0; leg < legs_.count(); ++leg) add_module(leg);
    link_within();
    link_neighbours();
    settings_.outputs = {"intra", "inter", "bias", "time_constant"};
    // An output that nothing reads is refused.
    if (!linked_outside_) settings_.outputs.erase(settings_.outputs.begin() + 1);
    add_properties();
  }
  substrate::Settings take() { return std::move(settings_); }

 private:
  std::string left_hidden(int leg) const { return legs_.name(leg) + ".hidden left"; }
  std::string right_hidden(int leg) const { return legs_.name(leg) + ".hidden right"; }
  std::string touch_of(int leg) const { return legs_.name(leg) + ".touch"; }
  /// Where a motor is in its module, −1 … 1 from left to right.
  double x_of(const LegMotor& motor, int leg) const {
    return evenly_spread(legs_.place_across(motor.type, legs_.is_right(leg)), legs_.types());
  }
  bool is_outer(const LegMotor& motor, int leg) const { return std::abs(x_of(motor, leg)) == 1.0; }
  bool has_group(const char* group) const {
    return std::ranges::find(settings_.nodes, group, &substrate::NodeSettings::group) !=
           settings_.nodes.end();
  }

  /// module_x and module_y.
  std::vector<double> place(int leg) const {
    for (std::size_t i = 0; i < legs_.pairs().size(); ++i) {
      const robot::LegPair& pair = legs_.pairs()[i];
      if (pair.left == leg) return {-1.0, legs_.pair_y(i)};
      if (pair.right == leg) return {1.0, legs_.pair_y(i)};
    }
    return {0.0, evenly_spread(legs_.count() - 1 - leg, legs_.count())};
  }

  void add_module(int leg) {
    const std::vector<double> module = place(leg);
    const auto add = [&](const std::string& name, const char* group, double x, double y) {
      auto& node = settings_.nodes.emplace_back();
      node.name = name;
      node.group = group;
      node.at = {x, y, module[0], module[1]};
      return &node;
    };
    add(touch_of(leg), touch, 0.0, -1.0)->sensor = "touch." + legs_.name(leg);
    add(left_hidden(leg), hidden, -1.0, 0.0);
    add(right_hidden(leg), hidden, 1.0, 0.0);
    for (const LegMotor& motor : legs_.motors_across(leg))
      add(motor.node, is_outer(motor, leg) ? outer : middle, x_of(motor, leg), 1.0)->joint = motor.joint;
  }

  void link_within() {
    const auto link = [&](const char* from, const char* to, bool both_ways) {
      settings_.links.push_back({from, to, "intra", {"module_x", "module_y"}, both_ways});
    };
    for (const char* from : {touch, hidden}) {
      if (from == std::string(touch)) link(touch, hidden, false);
      for (const char* to : {outer, middle})
        if (has_group(to)) link(from, to, false);
    }
    link(hidden, hidden, false);
    const auto has_both = [&](int leg) {
      const auto motors = legs_.motors(leg);
      const auto outers = std::ranges::count_if(motors, [&](const auto& m) { return is_outer(m, leg); });
      return outers > 0 && outers < std::ssize(motors);
    };
    for (int leg = 0; leg < legs_.count(); ++leg)
      if (has_both(leg)) return link(middle, outer, true);
  }

  void link_outside(const std::string& from, const std::string& to) {
    settings_.links.push_back({from, to, "inter", {}, true});
    linked_outside_ = true;
  }
  /// The motors of a module with the nodes of the one in front: left with left, right with right, and those
  /// between with the touch sensor.
  void link_lengthwise(int hind, int front) {
    for (const LegMotor& motor : legs_.motors_across(hind)) {
      const double x = x_of(motor, hind);
      link_outside(motor.node, x == -1.0  ? left_hidden(front)
                               : x == 1.0 ? right_hidden(front)
                                          : touch_of(front));
    }
  }
  /// The nodes that face each other across the robot.
  void link_crosswise(const robot::LegPair& pair) {
    link_outside(right_hidden(pair.left), left_hidden(pair.right));
    const auto left = legs_.motors_across(pair.left), right = legs_.motors_across(pair.right);
    if (!left.empty() && !right.empty()) link_outside(left.back().node, right.front().node);
  }
  void link_neighbours() {
    const auto& pairs = legs_.pairs();
    for (std::size_t i = 1; i < pairs.size(); ++i) link_lengthwise(pairs[i].left, pairs[i - 1].left);
    for (std::size_t i = 1; i < pairs.size(); ++i) link_lengthwise(pairs[i].right, pairs[i - 1].right);
    for (const robot::LegPair& pair : pairs) link_crosswise(pair);
    for (int leg = 1; pairs.empty() && leg < legs_.count(); ++leg) link_lengthwise(leg, leg - 1);
  }

  /// The authors' numbers: hidden biases of −1 … 1, motors' of 3, time constants of 1 … 61 steps.
  void add_properties() {
    const auto add = [&](const char* group, std::string_view property) {
      auto& added = settings_.properties.emplace_back();
      added.of = group;
      added.property = property;
      return &added;
    };
    add(hidden, bias_property)->output = bias_property;
    for (const char* group : {outer, middle})
      if (has_group(group)) add(group, bias_property)->value = 3.0;
    for (const char* group : {hidden, outer, middle}) {
      if (!has_group(group)) continue;
      auto* const added = add(group, time_constant_property);
      added->output = time_constant_property;
      added->low = 1.0;
      added->high = 61.0;
    }
  }

  AutomaticLegs legs_;
  substrate::Settings settings_;
  bool linked_outside_ = false;
};

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

substrate::Settings automatic_supg(const robot::RobotSpec& robot) {
  const AutomaticLegs legs(robot);
  substrate::Settings settings;
  settings.coordinates = {"leg", "joint_type"};
  settings.outputs = {"pattern", "offset"};
  for (int leg = 0; leg < legs.count(); ++leg)
    for (const LegMotor& motor : legs.motors(leg))
      settings.nodes.push_back({.name = motor.node,
                                .group = "supg",
                                .at = {supg_leg(leg, legs.count()), evenly_spread(motor.type, legs.types())},
                                .sensor = {},
                                .joint = motor.joint});
  settings.properties.resize(2);
  settings.properties[0].of = settings.properties[1].of = "supg";
  settings.properties[0].property = settings.properties[0].output = substrate::pattern_property;
  // Queried with joint type 0, so that the SUPGs of a leg share it (Morse et al. 2013, sec. 3).
  settings.properties[1].property = settings.properties[1].output = offset_property;
  settings.properties[1].zero = {"joint_type"};
  return settings;
}

substrate::Settings automatic_network(const robot::RobotSpec& robot) {
  const AutomaticLegs legs(robot);
  const Planes planes(legs);
  substrate::Settings settings;
  settings.coordinates = {"layer", "row", "column"};
  settings.outputs = {"weight"};
  add_network_inputs(legs, planes, settings);
  for (int leg = 0; leg < legs.count(); ++leg)
    for (int column = 0; column < planes.columns(); ++column)
      settings.nodes.push_back({.name = legs.name(leg) + ".hidden " + std::to_string(column + 1),
                                .group = "hidden",
                                .at = planes.at(0, leg, column),
                                .sensor = {},
                                .joint = {}});
  for (int leg = 0; leg < legs.count(); ++leg)
    for (const LegMotor& motor : legs.motors_across(leg))
      settings.nodes.push_back({.name = motor.node,
                                .group = "output",
                                .at = planes.at(1, leg, legs.place_across(motor.type, legs.is_right(leg))),
                                .sensor = {},
                                .joint = motor.joint});
  settings.links.resize(2);
  settings.links[0].from = "input";
  settings.links[0].to = settings.links[1].from = "hidden";
  settings.links[1].to = "output";
  return settings;
}

substrate::Settings automatic_ctrnn(const robot::RobotSpec& robot) {
  return Modules(robot).take();
}

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
