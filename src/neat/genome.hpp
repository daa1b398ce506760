#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

/// NEAT: genomes and their variation, species, populations.
namespace amble::neat {

/// Activation functions of CPPN nodes, of the sum x of what comes in (cppn/activation.hpp).
enum class Activation : std::uint8_t {
  bipolar_sigmoid = 0,  ///< 2 / (1 + e^−x) − 1
  gaussian = 1,         ///< 2 e^−(2.5 x)² − 1
  sine = 2,             ///< sin(2 x)
  linear = 3            ///< |x|, or x (cppn::Settings::linear)
};
/// As configs and genomes write them, by Activation.
inline constexpr std::array<std::string_view, 4> activation_names{"bipolar_sigmoid", "gaussian", "sine",
                                                                  "linear"};

/// What a node of a CPPN is.
enum class NodeKind : std::uint8_t {
  bias = 0,    ///< the constant 1; there is one
  input = 1,   ///< a coordinate of the point that is queried
  output = 2,  ///< what is asked for
  hidden = 3   ///< added by mutation
};
/// As genomes write them, by NodeKind.
inline constexpr std::array<std::string_view, 4> node_kind_names{"bias", "input", "output", "hidden"};

/// A node of a genome.
struct NodeGene {
  std::uint32_t id = 0;                        ///< given by Innovations
  NodeKind kind = NodeKind::hidden;            ///< decides the node's place in Genome::nodes
  Activation activation = Activation::linear;  ///< bias and inputs: linear, and not applied
  friend bool operator==(const NodeGene&, const NodeGene&) = default;
};

/// A link of a genome.
struct LinkGene {
  std::uint32_t innovation = 0;  ///< historical marking (Stanley & Miikkulainen 2002, sec. 3.2)
  std::uint32_t from = 0,        ///< id of the node whose value it carries
      to = 0;                    ///< id of the node that it adds to; never the bias or an input
  double weight = 0.0;           ///< factor of the value, finite
  bool enabled = true;           ///< false: kept, and inherited, but without effect
  friend bool operator==(const LinkGene&, const LinkGene&) = default;
};

/// A CPPN as NEAT evolves it. Nodes are in the order bias, inputs, outputs, hidden, each group by rising id
/// (ids of bias, inputs and outputs are 0, 1, …, so that node index = id for them). Links are sorted by
/// innovation number; no two join the same ordered pair of nodes.
struct Genome {
  std::vector<NodeGene> nodes;  ///< bias, inputs, outputs, hidden
  std::vector<LinkGene> links;  ///< by rising innovation number

  /// Number of nodes of this kind.
  int count(NodeKind kind) const;
  /// Number of links that are enabled.
  int enabled_links() const;
  /// Index into `nodes`, or −1.
  int index_of(std::uint32_t node_id) const;
  /// Hash of the whole genome, weights to the bit.
  std::uint64_t hash() const;
  friend bool operator==(const Genome&, const Genome&) = default;
};

/// @{
/// Inserts a gene at the position given by its number. The genome must not have it yet (not checked).
void insert_node(Genome& genome, const NodeGene& node);
void insert_link(Genome& genome, const LinkGene& link);
/// @}

/// Removes the hidden nodes without any link, enabled or not.
void remove_unlinked_hidden_nodes(Genome& genome);

/// Throws UserError (ExitCode::bad_file) naming the first error: order, unknown node, duplicate link, a
/// weight that is not finite, a link into an input, a link that closes a cycle where `recurrent` is false,
/// and so on. Disabled links count as links here, because crossover may enable them. Expects `inputs` (bias
/// not counted) and `outputs` nodes.
void validate(const Genome& genome, int inputs, int outputs, bool recurrent);

}  // namespace amble::neat
