#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace amble::figures {

enum class CppnRole { bias, input, output, hidden };

struct CppnNode {
  std::uint32_t id = 0;
  CppnRole role = CppnRole::hidden;
  std::string function;  ///< "bipolar_sigmoid", "gaussian", "sine", "linear" or "|x|"; unused for bias and
                         ///< inputs
  std::string name;      ///< of the bias, inputs and outputs
};

struct CppnLink {
  std::size_t from = 0, to = 0;  ///< indices into CppnGraph::nodes
  double weight = 0.0;
  bool enabled = true;
};

/// A CPPN as figures draw it.
struct CppnGraph {
  std::vector<CppnNode> nodes;
  std::vector<CppnLink> links;

  /// "pattern", or "node 7" for a node without a name.
  std::string name_of(std::size_t node) const;
  /// The largest |weight|; 1 if there is none above 0.
  double heaviest_weight() const;
};

/// A layered arrangement of the nodes of a CPPN, from its inputs to its outputs.
struct CppnPlaces {
  std::vector<std::vector<std::size_t>> layers;  ///< the nodes of each, in order; none is empty
  std::vector<std::size_t> layer;                ///< node by node
  std::vector<double> place;                     ///< node by node: within its layer, in (0, 1)

  /// Whether a link does not lead to a later layer: it closes a cycle, or leaves an output.
  bool leads_back(const CppnLink& link) const { return layer[link.from] >= layer[link.to]; }
};

/// Bias and inputs are in the first layer, outputs in the last, a hidden node in the layer given by its
/// longest path from the first; the nodes within a hidden layer are ordered so that few links cross
/// (barycentres: Sugiyama, Tagawa & Toda 1981).
CppnPlaces place_nodes(const CppnGraph& graph);

/// A CPPN in the DOT language of Graphviz: functions in the nodes, weights as widths, signs as colours,
/// disabled links dashed. Graphviz places the nodes, with inputs at one end and outputs at the other.
std::string cppn_dot(const CppnGraph& graph);

}  // namespace amble::figures
