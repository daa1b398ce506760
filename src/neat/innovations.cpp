#include "amble/neat/innovations.hpp"

#include <algorithm>
#include <limits>

#include "amble/core/check.hpp"

namespace amble::neat {
namespace {

constexpr std::size_t most_numbers = std::numeric_limits<std::uint32_t>::max();

}  // namespace

Innovations::Innovations(int inputs, int outputs)
    : first_hidden_(static_cast<std::uint32_t>(1 + inputs + outputs)) {}

std::uint32_t Innovations::link(std::uint32_t from, std::uint32_t to) {
  AMBLE_CHECK(is_node(from) && is_node(to), "a link joins nodes that were registered before");
  AMBLE_CHECK(links_.size() < most_numbers, "innovation numbers are used up");
  const auto next = static_cast<std::uint32_t>(links_.size());
  const auto [known, is_new] = innovation_of_.try_emplace({from, to}, next);
  if (is_new) links_.emplace_back(from, to);
  return known->second;
}

std::uint32_t Innovations::node(std::uint32_t innovation, Activation activation, const Genome& genome) {
  AMBLE_CHECK(innovation < links_.size(), "a split link was registered before");
  std::vector<std::uint32_t>& known = nodes_of_[{innovation, activation}];
  const auto free = std::ranges::find_if(known, [&](std::uint32_t id) { return genome.index_of(id) < 0; });
  if (free != known.end()) return *free;
  AMBLE_CHECK(first_hidden_ + splits_.size() < most_numbers, "node ids are used up");
  known.push_back(first_hidden_ + static_cast<std::uint32_t>(splits_.size()));
  splits_.push_back({innovation, activation});
  return known.back();
}

bool Innovations::knows(const Genome& genome) const {
  const auto node_is_known = [&](const NodeGene& node) {
    if (node.kind != NodeKind::hidden) return node.id < first_hidden_;
    return node.id >= first_hidden_ && is_node(node.id) &&
           splits_[node.id - first_hidden_].activation == node.activation;
  };
  const auto link_is_known = [&](const LinkGene& link) {
    return link.innovation < links_.size() && links_[link.innovation] == Ends{link.from, link.to};
  };
  return std::ranges::all_of(genome.nodes, node_is_known) && std::ranges::all_of(genome.links, link_is_known);
}

void Innovations::save(io::BinaryWriter& writer) const {
  writer.put(first_hidden_);
  writer.put(static_cast<std::uint64_t>(links_.size()));
  for (const auto& [from, to] : links_) {
    writer.put(from);
    writer.put(to);
  }
  writer.put(static_cast<std::uint64_t>(splits_.size()));
  for (const Split& split : splits_) {
    writer.put(split.innovation);
    writer.put(split.activation);
  }
}

void Innovations::load(io::BinaryReader& reader) {
  if (reader.get<std::uint32_t>() != first_hidden_) reader.bad("other numbers of inputs and outputs");
  links_.resize(reader.get_count(2 * sizeof(std::uint32_t)));
  innovation_of_.clear();
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const auto from = reader.get<std::uint32_t>(), to = reader.get<std::uint32_t>();
    links_[i] = {from, to};
    if (!innovation_of_.emplace(links_[i], static_cast<std::uint32_t>(i)).second)
      reader.bad("a link with two innovation numbers");
  }
  splits_.resize(reader.get_count(sizeof(std::uint32_t) + sizeof(Activation)));
  nodes_of_.clear();
  for (std::size_t i = 0; i < splits_.size(); ++i) {
    splits_[i].innovation = reader.get<std::uint32_t>();
    splits_[i].activation = reader.get_enum<Activation>(activation_names.size());
    if (splits_[i].innovation >= links_.size()) reader.bad("a node that splits an unknown link");
    nodes_of_[splits_[i]].push_back(first_hidden_ + static_cast<std::uint32_t>(i));
  }
  for (const auto& [from, to] : links_)
    if (!is_node(from) || !is_node(to)) reader.bad("a link that joins unknown nodes");
}

}  // namespace amble::neat
