#include "amble/substrate/settings.hpp"

namespace amble::substrate {
namespace {

constexpr io::Range coordinate_range{-1e6, 1e6};
constexpr io::Range value_range{-1e6, 1e6};

}  // namespace

void NodeSettings::describe(io::SettingsVisitor& visitor) {
  visitor.text("name", name,
               {"what the node is called; no other node may be called so, and no group of others"});
  visitor.text("group", group, {"links and properties name nodes by their groups"});
  visitor.numbers("at", at, coordinate_range, {"the node's position: one number per coordinate"});
  visitor.text(
      "sensor", sensor,
      {"what the node senses: angle.JOINT (rad), touch.LEG (0 or 1), load.LEG (N), speed.JOINT (rad/s), "
       "torque.JOINT (N m), roll, pitch, yaw (rad), yaw_rate (rad/s), command_speed (m/s), command_turn "
       "(rad/s), command_stop (0 or 1), heading_error (rad) or sine; empty: nothing"});
  visitor.text("joint", joint, {"joint that the node drives; each joint needs one; empty: none"});
}

void LinkSettings::describe(io::SettingsVisitor& visitor) {
  visitor.text("from", from, {"group or node where the links start"});
  visitor.text("to", to,
               {"group or node where they end; within a group every node is linked to every other, and to "
                "itself only by its own name"});
  visitor.text("weight", weight, {"CPPN output that gives the weights"});
  visitor.choice(
      "port", port, port_names,
      {.what = "what the links act on: a neuron's sum (hidden), or, with kind mixed, a SUPG: its leg's rate, "
               "its pattern's amplitude, a shift of it, or its leg's rate by the phase of another leg "
               "(coupling)",
       .first_is_implied = true});
  visitor.text(
      "times", times,
      {.what = "coordinate of the target that multiplies the weights, as the side does of what is to "
               "act on left and right in opposite senses; empty: none",
       .first_is_implied = true});
  visitor.texts("same", same, {"only nodes that agree in these coordinates are linked"});
  visitor.flag("both_ways", both_ways, {"whether the same links lead back, too"});
}

void PropertySettings::describe(io::SettingsVisitor& visitor) {
  visitor.text("of", of, {"group or node"});
  visitor.text("property", property,
               {"what is given: pattern or offset (supg), bias or time_constant (ctrnn; of both, mixed)"});
  visitor.text("output", output, {"CPPN output that gives it; empty: it is `value` everywhere"});
  visitor.number("low", low, value_range, {"the property where that output is −1 or less"});
  visitor.number("high", high, value_range, {"the property where that output is 1 or more"});
  visitor.number("value", value, value_range, {"the property if no output gives it"});
  visitor.texts("zero", zero,
                {"coordinates that are 0 when the CPPN is queried for it",
                 "Morse et al. 2013, sec. 3, for the SUPG's offset"});
}

void Settings::describe(io::SettingsVisitor& visitor) {
  visitor.choice(
      "layout", layout, layout_source_names,
      {.what =
           "whether nodes, links and properties are listed below, or made from the robot's legs and joints "
           "(auto; then coordinates, outputs and the lists are left out). controller.substrate = \"auto\" "
           "is short for a table with this key alone",
       .source = "Morse et al. 2013, fig. 4, 6, 7, for the quadruped",
       .first_is_implied = true});
  visitor.texts(
      "coordinates", coordinates,
      {"names of a node's coordinates. CPPN inputs: those of a link's source, then those of its "
       "target, which are 0 for properties of nodes; once only if there are no links; then time if a "
       "node has a pattern",
       "Morse et al. 2013, sec. 2.2"});
  visitor.texts("outputs", outputs, {"names of the CPPN's outputs, in order"});
  visitor.number("expression_threshold", expression_threshold, {0.0, 0.999},
                 {"outputs up to this size make no link; beyond, the weight grows from 0", "HyperSharpNEAT"});
  visitor.number("weight_range", weight_range, {1e-6, 1e6},
                 {"weight where the output is 1", "HyperSharpNEAT"});
  visitor.number("sine_period_s", sine_period_s, {1e-3, 1e6},
                 {"period of the sensor sine, s", "Morse et al. 2013, sec. 4"});
  visitor.choice(
      "attitude", attitude, attitude_names,
      {"the sensors roll, pitch and yaw read these angles (true_angles), or the result of a formula "
       "that takes a quaternion's w for its x: −yaw, pitch and −roll, within ± π/2",
       "the authors' code: misordered_quaternion"});
  visitor.tables("nodes", nodes, {"the nodes", "Morse et al. 2013, fig. 4, 6, 7"});
  visitor.tables("links", links, {"which nodes are linked", "Morse et al. 2013, fig. 6, 7"});
  visitor.tables("properties", properties,
                 {"what the CPPN gives single nodes", "Morse et al. 2013, sec. 2.2"});
}

}  // namespace amble::substrate
