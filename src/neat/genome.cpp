#include "amble/neat/genome.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/core/hash.hpp"
#include "amble/core/index.hpp"
#include "amble/neat/genome_io.hpp"
#include "amble/neat/graph.hpp"

namespace amble::neat {

int Genome::count(NodeKind kind) const {
  return static_cast<int>(std::ranges::count(nodes, kind, &NodeGene::kind));
}

int Genome::enabled_links() const {
  return static_cast<int>(std::ranges::count(links, true, &LinkGene::enabled));
}

int Genome::index_of(std::uint32_t node_id) const {
  // Hidden ids are larger than all others, so the whole list is in rising order.
  const auto found = std::ranges::lower_bound(nodes, node_id, {}, &NodeGene::id);
  return found != nodes.end() && found->id == node_id ? static_cast<int>(found - nodes.begin()) : -1;
}

std::uint64_t Genome::hash() const {
  io::BinaryWriter writer;
  save(*this, writer);
  return hash_text(writer.bytes());
}

void insert_node(Genome& genome, const NodeGene& node) {
  genome.nodes.insert(std::ranges::upper_bound(genome.nodes, node.id, {}, &NodeGene::id), node);
}

void insert_link(Genome& genome, const LinkGene& link) {
  genome.links.insert(std::ranges::upper_bound(genome.links, link.innovation, {}, &LinkGene::innovation),
                      link);
}

void remove_unlinked_hidden_nodes(Genome& genome) {
  std::vector<bool> linked(genome.nodes.size());
  for (const LinkGene& link : genome.links) {
    linked[to_index(genome.index_of(link.from))] = true;
    linked[to_index(genome.index_of(link.to))] = true;
  }
  std::size_t index = 0;
  std::erase_if(genome.nodes,
                [&](const NodeGene& node) { return !linked[index++] && node.kind == NodeKind::hidden; });
}

namespace {

constexpr ExitCode bad = ExitCode::bad_file;

void validate_node(const Genome& genome, std::size_t i, int inputs, int outputs) {
  const NodeGene& node = genome.nodes[i];
  const auto first_output = to_index(1 + inputs);
  const auto first_hidden = first_output + to_index(outputs);
  const NodeKind kind = i == 0             ? NodeKind::bias
                        : i < first_output ? NodeKind::input
                        : i < first_hidden ? NodeKind::output
                                           : NodeKind::hidden;
  if (node.kind != kind)
    fail(bad, "genome: node {} of the list must be of kind {}", i, node_kind_names[to_index(kind)]);
  if (i < first_hidden && node.id != i)
    fail(bad, "genome: node {} of the list has id {}, expected {}", i, node.id, i);
  if (i >= first_hidden &&
      (node.id < first_hidden || (i > first_hidden && node.id <= genome.nodes[i - 1].id)))
    fail(bad, "genome: hidden node {} is out of order: ids must rise from at least {}", node.id,
         first_hidden);
  if (to_index(node.activation) >= activation_names.size())
    fail(bad, "genome: node {} has an unknown activation function", node.id);
  if (i < first_output && node.activation != Activation::linear)
    fail(bad, "genome: node {} must have the activation linear, as bias and inputs do", node.id);
}

void validate_link(const Genome& genome, std::size_t i) {
  const LinkGene& link = genome.links[i];
  if (i > 0 && link.innovation <= genome.links[i - 1].innovation)
    fail(bad, "genome: link {} is out of order: innovation numbers must rise", link.innovation);
  for (const auto id : {link.from, link.to})
    if (genome.index_of(id) < 0)
      fail(bad, "genome: link {} names node {}, which is not there", link.innovation, id);
  const NodeKind target = genome.nodes[to_index(genome.index_of(link.to))].kind;
  if (target == NodeKind::bias || target == NodeKind::input)
    fail(bad, "genome: link {} leads into node {}, which is the bias or an input", link.innovation, link.to);
  if (!std::isfinite(link.weight))
    fail(bad, "genome: link {} has a weight that is not finite", link.innovation);
}

}  // namespace

void validate(const Genome& genome, int inputs, int outputs, bool recurrent) {
  const std::size_t fixed = 1 + to_index(inputs) + to_index(outputs);
  if (genome.nodes.size() < fixed)
    fail(bad, "genome: {} nodes, expected at least {}: bias, {} inputs, {} outputs", genome.nodes.size(),
         fixed, inputs, outputs);
  for (std::size_t i = 0; i < genome.nodes.size(); ++i) validate_node(genome, i, inputs, outputs);

  std::set<std::pair<std::uint32_t, std::uint32_t>> joined;
  for (std::size_t i = 0; i < genome.links.size(); ++i) {
    validate_link(genome, i);
    const LinkGene& link = genome.links[i];
    if (!joined.emplace(link.from, link.to).second)
      fail(bad, "genome: link {} joins nodes {} and {} a second time", link.innovation, link.from, link.to);
  }

  if (recurrent || !Graph(genome).has_cycle()) return;
  // There is a cycle: name the first link that closes one.
  Graph graph = Graph::without_links(genome);
  for (const LinkGene& link : genome.links) {
    const int from = genome.index_of(link.from), to = genome.index_of(link.to);
    if (graph.would_close_cycle(from, to))
      fail(bad,
           "genome: link {} from node {} to node {} closes a cycle, but the network must be feed-forward",
           link.innovation, link.from, link.to);
    graph.add(from, to);
  }
}

}  // namespace amble::neat
