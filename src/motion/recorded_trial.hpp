#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "amble/motion/motion.hpp"
#include "amble/robot/spec.hpp"

namespace amble::motion {

/// The temporal patterns of a SUPG controller (Morse et al. 2013, sec. 3).
struct SupgPatterns {
  int period_ticks = 0;
  double timestep_s = 0.0;
  bool starts_at_offset = true;   ///< whether a leg's timer starts at its offset, or after that many ticks
  std::vector<int> offset_ticks;  ///< per leg
  /// [joint][tick] in the order of robot::RobotSpec::joints, of those that belong to legs: the target angle
  /// at each tick of the timer, from 0 to period_ticks.
  std::vector<std::vector<double>> patterns_rad;

  double period_s() const { return period_ticks * timestep_s; }
};

/// From a recording's controller_json, of a controller that has "patterns_rad". Throws
/// UserError(ExitCode::bad_file) naming `what`: not JSON, or a key is missing or has a bad value.
SupgPatterns parse_supg(const std::string& controller_json, const robot::RobotSpec& robot,
                        const std::string& what);

enum class NodeRole { sensor, hidden, joint };

struct NetworkNode {
  std::string name;
  std::vector<double> at;  ///< its position in the substrate, one number per coordinate
  NodeRole role = NodeRole::hidden;
};

struct NetworkLink {
  int source = 0, target = 0;  ///< indices into NeuralNetwork::nodes
  double weight = 0.0;
  std::string port;  ///< what it acts on, where links differ in that: those of a mixed controller
};

/// The neural network of a controller, as a recording holds it.
struct NeuralNetwork {
  std::vector<std::string> coordinates;  ///< names of the substrate's coordinates
  std::vector<NetworkNode> nodes;
  std::vector<NetworkLink> links;  ///< those that are expressed
  int possible_links = 0;
};

/// The network of a recording's controller_json. Throws UserError(ExitCode::bad_file) naming `what`: a key is
/// missing or has the wrong type, or an index is out of range.
NeuralNetwork parse_network(const std::string& controller_json, const std::string& what);

/// A recording in memory.
struct RecordedTrial {
  robot::RobotSpec robot;
  Motion motion;
  std::string controller_kind;
  std::optional<SupgPatterns> supg;      ///< of controllers that have patterns
  std::optional<NeuralNetwork> network;  ///< of controllers that have nodes and links
};

/// Frames from the first that is not finite on are left out. Throws UserError: the file is missing or
/// altered, lacks a column, or its robot or controller JSON is not valid.
RecordedTrial read_recorded_trial(const std::filesystem::path& path);

}  // namespace amble::motion
