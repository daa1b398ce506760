#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "amble/io/settings.hpp"

/// HyperNEAT substrates: nodes and links of a controller, to which a CPPN gives numbers.
namespace amble::substrate {

/// The property of a node that is a function of time, −1 … 1 of a SUPG. All other properties are numbers, and
/// their names those that the controller gives them (Needs::properties).
inline constexpr std::string_view pattern_property = "pattern";

/// What the sensors roll, pitch and yaw read.
enum class Attitude {
  true_angles,  ///< these angles
  /// What the authors' code takes for them, by a formula that takes a quaternion's w for its x: −yaw, pitch
  /// and −roll, within ± π/2 (controllers/sensing.hpp).
  misordered_quaternion
};
/// As configs write them, by Attitude.
inline constexpr std::array<std::string_view, 2> attitude_names{"true_angles", "misordered_quaternion"};

/// Where a substrate's nodes, links and properties come from.
enum class LayoutSource {
  listed,    ///< the lists of the settings
  automatic  ///< the legs and joints of the robot (controllers::substrate_of)
};
/// As configs write them, by LayoutSource.
inline constexpr std::array<std::string_view, 2> layout_source_names{"listed", "auto"};

/// A node of the substrate and its coordinates: a sensor, a neuron, or a neuron or SUPG that drives a joint.
struct NodeSettings {
  std::string name;        ///< no other node has it, and no group of others
  std::string group;       ///< links and properties name nodes by their groups; may be empty
  std::vector<double> at;  ///< one number per coordinate, each −1e6 … 1e6; no other node has the same
  /// What it senses: angle.JOINT (rad), touch.LEG (0 or 1), load.LEG (N), speed.JOINT (rad/s), torque.JOINT
  /// (N m), roll, pitch, yaw (rad), yaw_rate (rad/s), command_speed (m/s), command_turn (rad/s), command_stop
  /// (0 or 1), heading_error (rad), sine; empty: nothing. A node that senses drives no joint.
  std::string sensor;
  std::string joint;  ///< name of the joint that it drives; empty: none. Each driven joint needs one node

  void describe(io::SettingsVisitor& visitor);  ///< an item of controller.substrate.nodes
};

/// What a link acts on. Ports other than `hidden` are those of SUPGs beside neurons (kind "mixed").
enum class Port {
  hidden,     ///< a neuron's sum
  rate,       ///< a SUPG: its leg's rate
  amplitude,  ///< a SUPG: how far its pattern swings about the middle of the joint's range
  shift,      ///< a SUPG: its target
  coupling    ///< a SUPG: its leg's rate, by the phase of another leg's SUPG
};
/// As configs write them, by Port.
inline constexpr std::array<std::string_view, 5> port_names{"hidden", "rate", "amplitude", "shift",
                                                            "coupling"};

/// Links between all nodes of two groups. Within a group each node is linked to every other, and to itself
/// only where both ends name that one node.
struct LinkSettings {
  std::string from,               ///< where the links start: a group, or one node
      to;                         ///< where they end: a group, or one node
  std::string weight = "weight";  ///< the CPPN output that gives the weights
  std::vector<std::string> same;  ///< only pairs that agree in these coordinates
  bool both_ways = false;         ///< whether the same links lead back, too
  Port port = Port::hidden;       ///< what they act on
  std::string times = {};         ///< coordinate of the target that multiplies the weights; empty: none

  void describe(io::SettingsVisitor& visitor);  ///< an item of controller.substrate.links
};

/// A property of all nodes of a group.
struct PropertySettings {
  std::string of;                 ///< a group, or one node
  std::string property = "bias";  ///< one that the kind of controller needs, e.g. pattern, offset, bias
  std::string output;             ///< the CPPN output that gives it; empty: it is `value` for all
  double low = -1.0,              ///< the property where that output is −1 or less, −1e6 … 1e6
      high = 1.0;                 ///< the property where it is 1 or more, likewise; linear in between
  double value = 0.0;             ///< the property if no output gives it, −1e6 … 1e6
  std::vector<std::string> zero;  ///< coordinates that are 0 when the CPPN is queried

  void describe(io::SettingsVisitor& visitor);  ///< an item of controller.substrate.properties
};

/// A HyperNEAT substrate as data: coordinates of a controller's nodes, what is linked, and which output of
/// the CPPN gives which weight or property (Morse et al. 2013, sec. 2.2 and figures 1, 4, 6, 7).
///
/// With LayoutSource::automatic the lists (coordinates, outputs, nodes, links, properties) are empty until
/// the robot is known. substrate::Layout checks that all fits together.
struct Settings {
  LayoutSource layout = LayoutSource::listed;  ///< where the lists come from
  std::vector<std::string> coordinates;  ///< names, in the order of NodeSettings::at and of the CPPN's inputs
  std::vector<std::string> outputs;      ///< names of the CPPN's outputs, in order
  /// Outputs up to this size make no link, 0 … 0.999 (HyperSharpNEAT); beyond, the weight grows from 0.
  double expression_threshold = 0.2;
  double weight_range = 3.0;   ///< weight where the output is 1, 1e−6 … 1e6 (HyperSharpNEAT)
  double sine_period_s = 1.0;  ///< period of the sensor "sine", 0.001 … 1e6
  Attitude attitude = Attitude::true_angles;  ///< what roll, pitch and yaw read
  std::vector<NodeSettings> nodes;            ///< sensors, neurons, SUPGs
  std::vector<LinkSettings> links;            ///< none for controllers of SUPGs alone
  std::vector<PropertySettings> properties;   ///< what the CPPN gives single nodes

  void describe(io::SettingsVisitor& visitor);  ///< the table [controller.substrate]
};

}  // namespace amble::substrate
