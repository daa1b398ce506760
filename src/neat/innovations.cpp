#include "amble/neat/innovations.hpp"

#include <algorithm>
#include <limits>

#include "amble/core/check.hpp"

namespace amble::neat {
namespace {

constexpr std::size_t most_numbers = std::numeric_limits<std::uint32_t>::max();

}  // namespace

Innovations::Innovations(int inputs, int outputs, const InnovationSettings& settings)
    : settings_(settings),
      first_hidden_(static_cast<std::uint32_t>(1 + inputs + outputs)),
      first_node_(first_hidden_) {}

Innovations Innovations::beyond(const Genome& genome, InnovationKey key) {
  Innovations innovations(genome.count(NodeKind::input), genome.count(NodeKind::output),
                          {InnovationScope::generation, key});
  for (const NodeGene& node : genome.nodes)
    innovations.first_node_ = std::max(innovations.first_node_, node.id + 1);
  for (const LinkGene& link : genome.links)
    innovations.first_link_ = std::max(innovations.first_link_, link.innovation + 1);
  return innovations;
}

void Innovations::begin_generation() {
  if (settings_.scope == InnovationScope::run) return;
  first_link_ = static_cast<std::uint32_t>(next_link());
  first_node_ = static_cast<std::uint32_t>(next_node());
  links_.clear();
  splits_.clear();
  innovation_of_.clear();
  nodes_of_.clear();
}

Innovations::Split Innovations::split_of(std::uint32_t innovation, Activation activation) const {
  return {innovation, settings_.key == InnovationKey::link ? Activation{} : activation};
}

std::uint32_t Innovations::link(std::uint32_t from, std::uint32_t to) {
  AMBLE_CHECK(from < next_node() && to < next_node(), "a link joins nodes that were registered before");
  AMBLE_CHECK(next_link() < most_numbers, "innovation numbers are used up");
  const auto [known, is_new] =
      innovation_of_.try_emplace({from, to}, static_cast<std::uint32_t>(next_link()));
  if (is_new) links_.emplace_back(from, to);
  return known->second;
}

std::uint32_t Innovations::node(std::uint32_t innovation, Activation activation, const Genome& genome) {
  AMBLE_CHECK(innovation < next_link(), "a split link was registered before");
  const Split split = split_of(innovation, activation);
  std::vector<std::uint32_t>& known = nodes_of_[split];
  const auto free = std::ranges::find_if(known, [&](std::uint32_t id) { return genome.index_of(id) < 0; });
  if (free != known.end()) return *free;
  AMBLE_CHECK(next_node() < most_numbers, "node ids are used up");
  known.push_back(static_cast<std::uint32_t>(next_node()));
  splits_.push_back(split);
  return known.back();
}

bool Innovations::knows(const Genome& genome) const {
  const auto node_is_known = [&](const NodeGene& node) {
    if (node.kind != NodeKind::hidden) return node.id < first_hidden_;
    if (node.id < first_hidden_ || node.id >= next_node()) return false;
    return node.id < first_node_ || settings_.key == InnovationKey::link ||
           splits_[node.id - first_node_].activation == node.activation;
  };
  const auto link_is_known = [&](const LinkGene& link) {
    if (link.innovation >= next_link()) return false;
    return link.innovation < first_link_ || links_[link.innovation - first_link_] == Ends{link.from, link.to};
  };
  return std::ranges::all_of(genome.nodes, node_is_known) && std::ranges::all_of(genome.links, link_is_known);
}

void Innovations::save(io::BinaryWriter& writer) const {
  writer.put(first_hidden_);
  writer.put(first_link_);
  writer.put(static_cast<std::uint64_t>(links_.size()));
  for (const auto& [from, to] : links_) {
    writer.put(from);
    writer.put(to);
  }
  writer.put(first_node_);
  writer.put(static_cast<std::uint64_t>(splits_.size()));
  for (const Split& split : splits_) {
    writer.put(split.innovation);
    writer.put(split.activation);
  }
}

void Innovations::load(io::BinaryReader& reader) {
  if (reader.get<std::uint32_t>() != first_hidden_) reader.bad("other numbers of inputs and outputs");
  first_link_ = reader.get<std::uint32_t>();
  links_.resize(reader.get_count(2 * sizeof(std::uint32_t)));
  innovation_of_.clear();
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const auto from = reader.get<std::uint32_t>(), to = reader.get<std::uint32_t>();
    links_[i] = {from, to};
    if (!innovation_of_.emplace(links_[i], first_link_ + static_cast<std::uint32_t>(i)).second)
      reader.bad("a link with two innovation numbers");
  }
  first_node_ = reader.get<std::uint32_t>();
  splits_.resize(reader.get_count(sizeof(std::uint32_t) + sizeof(Activation)));
  nodes_of_.clear();
  for (std::size_t i = 0; i < splits_.size(); ++i) {
    splits_[i].innovation = reader.get<std::uint32_t>();
    splits_[i].activation = reader.get_enum<Activation>(activation_names.size());
    if (splits_[i].innovation >= next_link()) reader.bad("a node that splits an unknown link");
    if (splits_[i] != split_of(splits_[i].innovation, splits_[i].activation))
      reader.bad("a split with a function where the link alone counts");
    nodes_of_[splits_[i]].push_back(first_node_ + static_cast<std::uint32_t>(i));
  }
  check_loaded(reader);
}

void Innovations::check_loaded(io::BinaryReader& reader) const {
  const bool forgets = settings_.scope == InnovationScope::generation;
  if (first_node_ < first_hidden_ || (!forgets && (first_link_ != 0 || first_node_ != first_hidden_)))
    reader.bad("a list of innovations that begins where it cannot");
  if (next_link() > most_numbers || next_node() > most_numbers) reader.bad("too many innovations");
  for (const auto& [from, to] : links_)
    if (from >= next_node() || to >= next_node()) reader.bad("a link that joins unknown nodes");
}

}  // namespace amble::neat
