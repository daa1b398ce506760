#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "amble/io/settings.hpp"

namespace amble::substrate {

/// The property of a node that is a function of time, −1 … 1 of a SUPG. All other properties are numbers, and
/// their names those that the controller gives them (Needs::properties).
inline constexpr std::string_view pattern_property = "pattern";

/// What the sensors roll, pitch and yaw read: the angles, or what the authors' code takes for them
/// (controllers/sensing.hpp).
enum class Attitude { true_angles, misordered_quaternion };
inline constexpr std::array<std::string_view, 2> attitude_names{"true_angles", "misordered_quaternion"};

/// Where a substrate's nodes, links and properties come from: the lists of the settings, or the legs and
/// joints of the robot (controllers/automatic.hpp).
enum class LayoutSource { listed, automatic };
inline constexpr std::array<std::string_view, 2> layout_source_names{"listed", "auto"};

/// A node of the substrate and its coordinates: a sensor, a neuron, or a neuron or SUPG that drives a joint.
struct NodeSettings {
  std::string name;
  std::string group;       ///< links and properties name nodes by their groups
  std::vector<double> at;  ///< one number per coordinate
  std::string sensor;      ///< empty: none (sensor.hpp)
  std::string joint;       ///< name of the joint that it drives; empty: none

  void describe(io::SettingsVisitor& visitor);
};

/// What a link acts on. Ports other than `hidden` are those of SUPGs beside neurons (controllers/mixed.hpp).
enum class Port { hidden, rate, amplitude, shift, coupling };
inline constexpr std::array<std::string_view, 5> port_names{"hidden", "rate", "amplitude", "shift",
                                                            "coupling"};

/// Links between all nodes of two groups.
struct LinkSettings {
  std::string from, to;           ///< a group, or one node
  std::string weight = "weight";  ///< the CPPN output that gives the weights
  std::vector<std::string> same;  ///< only pairs that agree in these coordinates
  bool both_ways = false;
  Port port = Port::hidden;
  std::string times = {};  ///< coordinate of the target that multiplies the weights; empty: none

  void describe(io::SettingsVisitor& visitor);
};

/// A property of all nodes of a group.
struct PropertySettings {
  std::string of;  ///< a group, or one node
  std::string property = "bias";
  std::string output;             ///< the CPPN output that gives it; empty: it is `value` for all
  double low = -1.0, high = 1.0;  ///< the property where that output is −1, and where it is 1
  double value = 0.0;
  std::vector<std::string> zero;  ///< coordinates that are 0 when the CPPN is queried

  void describe(io::SettingsVisitor& visitor);
};

/// A HyperNEAT substrate as data: coordinates of a controller's nodes, what is linked, and which output of
/// the CPPN gives which weight or property (Morse et al. 2013, sec. 2.2 and figures 1, 4, 6, 7).
///
/// With LayoutSource::automatic the lists (coordinates, outputs, nodes, links, properties) are empty until
/// the robot is known.
struct Settings {
  LayoutSource layout = LayoutSource::listed;
  std::vector<std::string> coordinates;  ///< names, in the order of NodeSettings::at and of the CPPN's inputs
  std::vector<std::string> outputs;      ///< names of the CPPN's outputs, in order
  double expression_threshold = 0.2;     ///< outputs up to this size make no link
  double weight_range = 3.0;             ///< weight where the output is 1
  double sine_period_s = 1.0;            ///< of the sensor "sine"
  Attitude attitude = Attitude::true_angles;
  std::vector<NodeSettings> nodes;
  std::vector<LinkSettings> links;
  std::vector<PropertySettings> properties;

  void describe(io::SettingsVisitor& visitor);
};

}  // namespace amble::substrate
