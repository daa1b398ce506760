#include "amble/neat/genome_io.hpp"

#include <cstring>

#include "amble/core/error.hpp"

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

namespace {

void put(std::string& bytes, std::uint64_t value) {
  for (; value >= 128; value >>= 7) bytes.push_back(static_cast<char>(value | 128));
  bytes.push_back(static_cast<char>(value));
}

class CompactReader {
 public:
  CompactReader(std::string_view bytes, const std::string& what) : rest_(bytes), what_(what) {}

  std::uint64_t number() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 63; shift += 7) {
      const auto byte = static_cast<unsigned char>(take(1)[0]);
      value |= std::uint64_t{byte & 127u} << shift;
      if (byte < 128) return value;
    }
    bad();
  }
  std::uint32_t number32() {
    const std::uint64_t value = number();
    if (value > 0xffffffffu) bad();
    return static_cast<std::uint32_t>(value);
  }
  /// A length; each item has at least a byte.
  std::size_t count() {
    const std::uint64_t value = number();
    if (value > rest_.size()) bad();
    return static_cast<std::size_t>(value);
  }
  double weight() {
    double value = 0.0;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  void finish() const {
    if (!rest_.empty()) bad();
  }
  [[noreturn]] void bad() const { fail(ExitCode::bad_file, "{}: not a genome", what_); }

 private:
  std::string_view take(std::size_t size) {
    if (rest_.size() < size) bad();
    const auto taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }

  std::string_view rest_;
  const std::string& what_;
};

}  // namespace

std::string compact(const Genome& genome) {
  std::string bytes;
  bytes.reserve(4 + 3 * genome.nodes.size() + 13 * genome.links.size());
  put(bytes, genome.nodes.size());
  std::uint32_t before = 0;
  for (const NodeGene& node : genome.nodes) {
    bytes.push_back(
        static_cast<char>(static_cast<unsigned>(node.kind) * 16 + static_cast<unsigned>(node.activation)));
    put(bytes, node.id - before);  // modulo 2³² if the order is wrong
    before = node.id;
  }
  put(bytes, genome.links.size());
  before = 0;
  for (const LinkGene& link : genome.links) {
    put(bytes, std::uint64_t{link.innovation - before} * 2 + (link.enabled ? 1 : 0));
    before = link.innovation;
    put(bytes, link.from);
    put(bytes, link.to);
    bytes.append(reinterpret_cast<const char*>(&link.weight), sizeof link.weight);
  }
  return bytes;
}

Genome expand(std::string_view bytes, const std::string& what) {
  CompactReader reader(bytes, what);
  Genome genome;
  genome.nodes.resize(reader.count());
  std::uint32_t before = 0;
  for (NodeGene& node : genome.nodes) {
    const auto kind = reader.number();  // one byte below 128
    if (kind / 16 >= node_kind_names.size() || kind % 16 >= activation_names.size()) reader.bad();
    node.kind = static_cast<NodeKind>(kind / 16);
    node.activation = static_cast<Activation>(kind % 16);
    node.id = before += reader.number32();
  }
  genome.links.resize(reader.count());
  before = 0;
  for (LinkGene& link : genome.links) {
    const std::uint64_t number = reader.number();
    if (number > 0x1ffffffffu) reader.bad();
    link.enabled = number % 2 == 1;
    link.innovation = before += static_cast<std::uint32_t>(number / 2);
    link.from = reader.number32();
    link.to = reader.number32();
    link.weight = reader.weight();
  }
  reader.finish();
  return genome;
}

}  // namespace amble::neat
