#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/cppn/network.hpp"
#include "amble/robot/spec.hpp"
#include "amble/substrate/sensor.hpp"
#include "amble/substrate/settings.hpp"

namespace amble::substrate {

/// Collects the points at which a CPPN will be queried; equal points are one.
class QueryPoints {
 public:
  /// Index of the point with these inputs, in the order in which new ones came. Equal are those with the same
  /// numbers; all points have as many.
  int add(const std::vector<float>& inputs) {
    const auto [entry, is_new] = index_.try_emplace(inputs, static_cast<int>(in_order_.size()));
    if (is_new) in_order_.push_back(inputs);
    return entry->second;
  }

  /// All points so far, of `inputs` coordinates each.
  cppn::Points points(int inputs) const {
    cppn::Points points(inputs, static_cast<int>(in_order_.size()));
    for (std::size_t i = 0; i < in_order_.size(); ++i)
      for (int k = 0; k < inputs; ++k) points.set(static_cast<int>(i), k, in_order_[i][to_index(k)]);
    return points;
  }

 private:
  std::map<std::vector<float>, int> index_;
  std::vector<std::vector<float>> in_order_;
};

/// How a CPPN is told the time t of a pattern, in periods.
enum class TimeInputs {
  line,   ///< t
  circle  ///< sin 2πt and cos 2πt, which are the same at the end of the period as at its beginning
};
/// As configs write them, by TimeInputs.
inline constexpr std::array<std::string_view, 2> time_inputs_names{"line", "circle"};

/// The inputs of tick 0 … `pattern_ticks` of a pattern: `inputs` has one place, or two on a circle. The same
/// on every CPU.
void set_time_inputs(TimeInputs time, int tick, int pattern_ticks, std::span<float> inputs);

/// What a kind of controller needs of a substrate.
struct Needs {
  std::string_view kind;                ///< value of controller.kind, for messages
  bool network = true;                  ///< whether there are links, sensors and nodes that drive no joint
  std::vector<std::string> properties;  ///< that each node but the sensors must have
  /// Where it is not empty: what nodes that drive no joint must have in place of `properties`, and links may
  /// have any port.
  std::vector<std::string> neuron_properties = {};
  int pattern_ticks = 0;  ///< patterns are queried at times 0, 1/ticks, …, 1; 0: there are none
  TimeInputs time = TimeInputs::line;  ///< how the CPPN is told that time
  /// Names of inputs behind those of the substrate, for queries of the controller's own; 0 in all of the
  /// layout's.
  std::vector<std::string> more_inputs = {};
  /// Names of outputs behind those of the substrate, which the layout does not read.
  std::vector<std::string> more_outputs = {};
};

/// A node of the substrate, its sensor and joint found in the robot.
struct Node {
  std::string name,              ///< NodeSettings::name
      group;                     ///< NodeSettings::group
  std::vector<double> at;        ///< one number per coordinate
  std::optional<Sensor> sensor;  ///< what it senses; nothing: it is no sensor
  int joint = -1;                ///< index in RobotSpec::joints; −1: drives none
};

/// A link between two nodes.
struct Link {
  int source = 0,            ///< index of the node where it starts
      target = 0;            ///< index of the node where it ends
  int output = 0;            ///< CPPN output that gives the weight, from 0
  Port port = Port::hidden;  ///< what it acts on
  double factor = 1.0;       ///< what the weight is multiplied by (LinkSettings::times)
};

/// The numbers that a CPPN gives a substrate: one set per genome.
struct Decoded {
  /// A property of all nodes.
  struct Values {
    std::string property;        ///< its name
    std::vector<float> by_node;  ///< 0 where a node lacks it
  };

  std::vector<float> weights;      ///< link by link; 0 where the link is not expressed
  std::vector<Values> properties;  ///< all that the controller needs; empty for patterns
  std::vector<float> patterns;  ///< node by node, tick by tick: 0 … pattern_ticks; 0 where a node has none

  /// A property's numbers by node. AMBLE_CHECK: it is one that the controller needs.
  std::span<const float> of(std::string_view property) const;
};

/// A substrate prepared for many genomes: checked against robot and controller, with the query points
/// collected once. Const and shared by all workers.
///
/// CPPN inputs: the coordinates of a link's source, then those of its target. For a property of a node these
/// are the node's own and zeros (Morse et al. 2013, figure 1). Without links there is one set of coordinates.
/// If a node has a pattern, time in periods is one more input, `time`, or two, `time.sin` and `time.cos`
/// (TimeInputs), 0 for everything but patterns.
///
/// Outputs o are clamped to −1 … 1. A link's weight is 0 where |o| is at most the expression threshold t, and
/// else sign(o) (|o| − t)/(1 − t) × weight_range (HyperSharpNEAT), times Link::factor. A property is linear
/// in o: `low` at −1, `high` at 1.
class Layout {
 public:
  /// Throws SettingError naming the key where settings, robot and controller do not fit. The lists of
  /// `settings` are there (controllers::substrate_of makes them from a robot).
  Layout(const Settings& settings, const Needs& needs, const robot::RobotSpec& robot);

  const std::vector<std::string>& coordinates() const { return coordinates_; }  ///< their names
  /// Names of the CPPN's inputs, in order; the bias is not among them.
  const std::vector<std::string>& input_names() const { return input_names_; }
  /// Names of the CPPN's outputs, in order.
  const std::vector<std::string>& output_names() const { return output_names_; }
  /// In the order of the settings.
  const std::vector<Node>& nodes() const { return nodes_; }
  /// Item by item of the settings, then source by source; the reverse of a link follows it.
  const std::vector<Link>& links() const { return links_; }
  /// As many as RobotSpec::joints.
  int joint_count() const { return static_cast<int>(drivers_.size()); }
  /// The node that drives a joint; −1: it is held (robot::Joint::driven).
  int driver(int joint) const { return drivers_[to_index(joint)]; }
  /// Whether two nodes get the same value of a property from every CPPN, because they query it alike.
  /// AMBLE_CHECK: both have it.
  bool shared(std::string_view property, int a, int b) const;
  /// The least possible value of a property, over all nodes; infinity if none has it.
  double lowest(std::string_view property) const;

  /// Where a CPPN is queried.
  const cppn::Points& points() const { return points_; }
  /// What this CPPN makes of the substrate. AMBLE_CHECK: it has the inputs and outputs of input_names() and
  /// output_names(). Thread safe.
  Decoded decode(const cppn::Network& network) const;
  /// The patterns alone, as in `Decoded`, where the CPPN has these numbers as Needs::more_inputs in place of
  /// 0.
  std::vector<float> patterns(const cppn::Network& network, std::span<const float> more_inputs) const;

 private:
  friend class LayoutBuilder;

  /// A property of one node.
  struct Source {
    int node = 0;
    int property = 0;  ///< of properties_
    bool pattern = false;
    int output = -1;  ///< −1: none, the property is `value`
    double low = 0.0, high = 0.0, value = 0.0;
    std::vector<int> points;  ///< one; for a pattern tick by tick
  };
  const Source& source(std::string_view property, int node) const;
  int property_index(std::string_view property) const;
  /// One number of the results of cppn::Network::evaluate().
  float output_at(std::span<const float> results, int output, int point) const;
  void decode_weights(std::span<const float> results, Decoded& decoded) const;
  void decode_properties(std::span<const float> results, Decoded& decoded) const;
  /// A number, or tick by tick.
  void decode_source(const Source& source, std::span<const float> results, float* values) const;

  std::vector<std::string> coordinates_, input_names_, output_names_;
  double expression_threshold_ = 0.0, weight_range_ = 0.0;
  int pattern_ticks_ = 0;
  std::vector<std::string> properties_;
  std::vector<Node> nodes_;
  std::vector<Link> links_;
  std::vector<int> link_points_;  ///< link by link
  std::vector<int> drivers_;      ///< joint by joint; −1: none
  std::vector<Source> sources_;
  cppn::Points points_{0, 0};
};

/// Text for people: the CPPN's inputs and outputs, every node, how many links there are between groups and by
/// which output, properties, and every link. `layout` was made from `settings`.
std::string summary(const Settings& settings, const Layout& layout);

}  // namespace amble::substrate
