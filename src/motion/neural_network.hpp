#pragma once

#include <string>
#include <vector>

namespace amble::motion {

enum class NodeRole { sensor, hidden, joint };

struct NetworkNode {
  std::string name;
  std::vector<double> at;  ///< its position in the substrate, one number per coordinate
  NodeRole role = NodeRole::hidden;
};

struct NetworkLink {
  int source = 0, target = 0;  ///< indices into NeuralNetwork::nodes
  double weight = 0.0;
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

}  // namespace amble::motion
