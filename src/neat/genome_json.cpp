#include "amble/neat/genome_json.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "amble/core/index.hpp"
#include "amble/neat/genome_io.hpp"

namespace amble::neat {
namespace {

std::uint32_t number_from_json(const io::JsonView& json) {
  constexpr std::int64_t highest = std::numeric_limits<std::uint32_t>::max();
  const std::int64_t value = json.integer();
  if (value < 0 || value > highest) json.bad(fmt::format("a whole number from 0 to {}", highest));
  return static_cast<std::uint32_t>(value);
}

template <typename Enum, std::size_t N>
Enum name_from_json(const io::JsonView& json, const std::array<std::string_view, N>& names) {
  const auto found = std::ranges::find(names, json.text());
  if (found == names.end()) json.bad(fmt::format("one of {}", fmt::join(names, ", ")));
  return static_cast<Enum>(found - names.begin());
}

}  // namespace

io::Json to_json(const Genome& genome) {
  io::Json nodes = io::Json::array(), links = io::Json::array();
  for (const NodeGene& node : genome.nodes)
    nodes.push_back({{"id", node.id},
                     {"kind", node_kind_names[to_index(node.kind)]},
                     {"activation", activation_names[to_index(node.activation)]}});
  for (const LinkGene& link : genome.links)
    links.push_back({{"innovation", link.innovation},
                     {"from", link.from},
                     {"to", link.to},
                     {"weight", link.weight},
                     {"enabled", link.enabled}});
  return {{"nodes", std::move(nodes)}, {"links", std::move(links)}};
}

std::string genome_text(const Genome& genome) {
  return io::json_text(to_json(genome));
}

Genome parse_genome(const std::string& text, const std::string& what) {
  const io::Json json = io::parse_json(text, what);
  return genome_from_json(io::JsonView(json, what));
}

Genome genome_from_json(const io::JsonView& json) {
  const io::JsonView nodes = json.at("nodes"), links = json.at("links");
  Genome genome;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const io::JsonView node = nodes.at(i);
    genome.nodes.push_back(
        {.id = number_from_json(node.at("id")),
         .kind = name_from_json<NodeKind>(node.at("kind"), node_kind_names),
         .activation = name_from_json<Activation>(node.at("activation"), activation_names)});
  }
  for (std::size_t i = 0; i < links.size(); ++i) {
    const io::JsonView link = links.at(i);
    genome.links.push_back({.innovation = number_from_json(link.at("innovation")),
                            .from = number_from_json(link.at("from")),
                            .to = number_from_json(link.at("to")),
                            .weight = link.at("weight").number(),
                            .enabled = link.at("enabled").flag()});
    if (!std::isfinite(genome.links.back().weight)) link.at("weight").bad("a finite number");
  }
  return genome;
}

}  // namespace amble::neat
