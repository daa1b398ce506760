#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace amble::neat {

/// Activation functions of CPPN nodes. Their formulas are in cppn/activation.hpp.
enum class Activation : std::uint8_t { bipolar_sigmoid = 0, gaussian = 1, sine = 2, linear = 3 };
inline constexpr std::array<std::string_view, 4> activation_names{"bipolar_sigmoid", "gaussian", "sine",
                                                                  "linear"};

enum class NodeKind : std::uint8_t { bias = 0, input = 1, output = 2, hidden = 3 };
inline constexpr std::array<std::string_view, 4> node_kind_names{"bias", "input", "output", "hidden"};

struct NodeGene {
  std::uint32_t id = 0;  ///< given by Innovations
  NodeKind kind = NodeKind::hidden;
  Activation activation = Activation::linear;  ///< bias and inputs: linear, and not applied
  friend bool operator==(const NodeGene&, const NodeGene&) = default;
};

struct LinkGene {
  std::uint32_t innovation = 0;    ///< historical marking (Stanley & Miikkulainen 2002, sec. 3.2)
  std::uint32_t from = 0, to = 0;  ///< node ids; `to` is never the bias or an input
  double weight = 0.0;
  bool enabled = true;
  friend bool operator==(const LinkGene&, const LinkGene&) = default;
};

/// A CPPN as NEAT evolves it. Nodes are in the order bias, inputs, outputs, hidden, each group by rising id
/// (ids of bias, inputs and outputs are 0, 1, …, so that node index = id for them). Links are sorted by
/// innovation number; no two join the same ordered pair of nodes.
struct Genome {
  std::vector<NodeGene> nodes;
  std::vector<LinkGene> links;

  int count(NodeKind kind) const;
  int enabled_links() const;
  /// Index into `nodes`, or −1.
  int index_of(std::uint32_t node_id) const;
  /// Hash of the whole genome, weights to the bit.
  std::uint64_t hash() const;
  friend bool operator==(const Genome&, const Genome&) = default;
};

/// Inserts a gene at the position given by its number. The genome must not have it yet.
void insert_node(Genome& genome, const NodeGene& node);
void insert_link(Genome& genome, const LinkGene& link);

/// Removes the hidden nodes without any link, enabled or not.
void remove_unlinked_hidden_nodes(Genome& genome);

/// Throws UserError (ExitCode::bad_file) naming the first error: order, unknown node, duplicate link, a
/// weight that is not finite, a link into an input, a link that closes a cycle where `recurrent` is false,
/// and so on. Disabled links count as links here, because crossover may enable them. Expects `inputs` (bias
/// not counted) and `outputs` nodes.
void validate(const Genome& genome, int inputs, int outputs, bool recurrent);

}  // namespace amble::neat
