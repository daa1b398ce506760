#include "amble/neat/genome.hpp"

#include <algorithm>

#include "amble/core/hash.hpp"
#include "amble/core/index.hpp"
#include "amble/neat/genome_binary.hpp"

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

}  // namespace amble::neat
