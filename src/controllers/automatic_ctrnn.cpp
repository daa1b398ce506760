#include <algorithm>
#include <string>
#include <vector>

#include "amble/controllers/automatic.hpp"
#include "amble/controllers/automatic_legs.hpp"
#include "amble/controllers/ctrnn.hpp"
#include "amble/core/index.hpp"

namespace amble::controllers {
namespace {

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
  /// Of a motor in its module, −1 … 1 from left to right.
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

}  // namespace

substrate::Settings automatic_ctrnn(const robot::RobotSpec& robot) {
  return Modules(robot).take();
}

}  // namespace amble::controllers
