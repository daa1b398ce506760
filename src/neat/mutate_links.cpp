#include <cstddef>
#include <utility>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/neat/graph.hpp"
#include "amble/neat/mutation.hpp"

namespace amble::neat {
namespace {

/// Pairs of node indices that a new link may join, in a fixed order.
std::vector<std::pair<std::size_t, std::size_t>> free_pairs(const Genome& genome, bool recurrent) {
  const std::size_t count = genome.nodes.size();
  const Graph graph(genome);
  std::vector<std::vector<bool>> taken(count, std::vector<bool>(count));
  for (const LinkGene& link : genome.links)
    taken[to_index(genome.index_of(link.to))][to_index(genome.index_of(link.from))] = true;

  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t to = 0; to < count; ++to) {
    const NodeKind kind = genome.nodes[to].kind;
    if (kind == NodeKind::bias || kind == NodeKind::input) continue;
    // A link from a node that `to` leads to would close a cycle.
    const std::vector<bool> barred =
        recurrent ? std::vector<bool>(count) : graph.reachable_from(static_cast<int>(to));
    for (std::size_t from = 0; from < count; ++from)
      if (!taken[to][from] && !barred[from]) pairs.emplace_back(from, to);
  }
  return pairs;
}

}  // namespace

bool add_link(Genome& genome, double weight_limit, bool recurrent, Innovations& innovations, Stream& stream) {
  const auto pairs = free_pairs(genome, recurrent);
  if (pairs.empty()) return false;
  const auto [from_index, to_index] = pairs[stream.below(static_cast<std::uint32_t>(pairs.size()))];
  const std::uint32_t from = genome.nodes[from_index].id, to = genome.nodes[to_index].id;
  insert_link(genome, {.innovation = innovations.link(from, to),
                       .from = from,
                       .to = to,
                       .weight = stream.uniform(-weight_limit, weight_limit),
                       .enabled = true});
  return true;
}

bool delete_link(Genome& genome, Stream& stream) {
  if (genome.links.empty()) return false;
  const std::uint32_t place = stream.below(static_cast<std::uint32_t>(genome.links.size()));
  genome.links.erase(genome.links.begin() + static_cast<std::ptrdiff_t>(place));
  remove_unlinked_hidden_nodes(genome);
  return true;
}

}  // namespace amble::neat
