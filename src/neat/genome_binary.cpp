#include "amble/neat/genome_binary.hpp"

namespace amble::neat {
namespace {

constexpr std::size_t node_bytes = 4 + 1 + 1, link_bytes = 4 + 4 + 4 + 8 + 1;
constexpr std::size_t least_genome_bytes = 8 + 8;  ///< the two counts

}  // namespace

void save(const Genome& genome, io::BinaryWriter& writer) {
  writer.put(static_cast<std::uint64_t>(genome.nodes.size()));
  for (const NodeGene& node : genome.nodes) {
    writer.put(node.id);
    writer.put(node.kind);
    writer.put(node.activation);
  }
  writer.put(static_cast<std::uint64_t>(genome.links.size()));
  for (const LinkGene& link : genome.links) {
    writer.put(link.innovation);
    writer.put(link.from);
    writer.put(link.to);
    writer.put(link.weight);
    writer.put(static_cast<std::uint8_t>(link.enabled));
  }
}

Genome load_genome(io::BinaryReader& reader) {
  Genome genome;
  genome.nodes.resize(reader.get_count(node_bytes));
  for (NodeGene& node : genome.nodes) {
    node.id = reader.get<std::uint32_t>();
    node.kind = reader.get_enum<NodeKind>(node_kind_names.size());
    node.activation = reader.get_enum<Activation>(activation_names.size());
  }
  genome.links.resize(reader.get_count(link_bytes));
  for (LinkGene& link : genome.links) {
    link.innovation = reader.get<std::uint32_t>();
    link.from = reader.get<std::uint32_t>();
    link.to = reader.get<std::uint32_t>();
    link.weight = reader.get<double>();
    const auto enabled = reader.get<std::uint8_t>();
    if (enabled > 1) reader.bad("a link is neither enabled nor disabled");
    link.enabled = enabled == 1;
  }
  return genome;
}

void save(std::span<const Genome> genomes, io::BinaryWriter& writer) {
  writer.put(static_cast<std::uint64_t>(genomes.size()));
  for (const Genome& genome : genomes) save(genome, writer);
}

std::vector<Genome> load_genomes(io::BinaryReader& reader) {
  std::vector<Genome> genomes(reader.get_count(least_genome_bytes));
  for (Genome& genome : genomes) genome = load_genome(reader);
  return genomes;
}

}  // namespace amble::neat
