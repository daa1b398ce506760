#include "amble/neat/mutation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/neat/graph.hpp"
#include "amble/neat/shares.hpp"

namespace amble::neat {
namespace {

bool apply(Mutation mutation, Genome& genome, const Settings& settings, bool recurrent,
           Innovations& innovations, Stream& stream) {
  const double weight_limit = settings.genome.weight_limit;
  switch (mutation) {
    case Mutation::weights:
      return mutate_weights(genome, settings.mutation.weights, weight_limit, stream);
    case Mutation::add_link:
      return add_link(genome, weight_limit, recurrent, innovations, stream);
    case Mutation::add_node:
      return add_node(genome, settings, innovations, stream);
    case Mutation::delete_link:
      return delete_link(genome, stream);
    case Mutation::none:
      break;
  }
  AMBLE_CHECK(false, "the roulette contains operators only");
  return false;
}

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

/// One way to change weights.
struct Change {
  double share;
  double probability;  ///< of each link; 0: exactly one link
  bool reset;          ///< drawn anew, or else jiggled
};

}  // namespace

Mutation mutate(Genome& genome, const Settings& settings, bool recurrent, Innovations& innovations,
                Stream& stream) {
  const MutationSettings& m = settings.mutation;
  std::array<double, 4> shares{m.weights_share, m.add_link_share, m.add_node_share, m.delete_link_share};
  while (std::ranges::max(shares) > 0.0) {
    const std::size_t drawn = roulette(shares, stream);
    const auto mutation = static_cast<Mutation>(drawn);
    if (apply(mutation, genome, settings, recurrent, innovations, stream)) return mutation;
    shares[drawn] = 0.0;
  }
  return Mutation::none;
}

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

bool add_node(Genome& genome, const Settings& settings, Innovations& innovations, Stream& stream) {
  std::vector<std::size_t> candidates;
  for (std::size_t i = 0; i < genome.links.size(); ++i)
    if (genome.links[i].enabled) candidates.push_back(i);
  if (candidates.empty()) return false;

  const std::size_t split = candidates[stream.below(static_cast<std::uint32_t>(candidates.size()))];
  const LinkGene old = genome.links[split];
  const auto activation = static_cast<Activation>(roulette(settings.genome.activation_shares, stream));
  const std::uint32_t id = innovations.node(old.innovation, activation, genome);

  if (settings.mutation.split_link == SplitLink::remove)
    genome.links.erase(genome.links.begin() + static_cast<std::ptrdiff_t>(split));
  else
    genome.links[split].enabled = false;
  insert_node(genome, {.id = id, .kind = NodeKind::hidden, .activation = activation});
  insert_link(genome, {.innovation = innovations.link(old.from, id),
                       .from = old.from,
                       .to = id,
                       .weight = std::min(1.0, settings.genome.weight_limit),
                       .enabled = true});
  insert_link(genome, {.innovation = innovations.link(id, old.to),
                       .from = id,
                       .to = old.to,
                       .weight = old.weight,
                       .enabled = true});
  return true;
}

bool mutate_weights(Genome& genome, const WeightMutationSettings& settings, double weight_limit,
                    Stream& stream) {
  if (genome.links.empty()) return false;
  const std::array<Change, 5> changes{{{settings.jiggle_many_share, settings.jiggle_many_probability, false},
                                       {settings.jiggle_few_share, settings.jiggle_few_probability, false},
                                       {settings.jiggle_one_share, 0.0, false},
                                       {settings.reset_few_share, settings.reset_few_probability, true},
                                       {settings.reset_one_share, 0.0, true}}};
  std::array<double, 5> shares{};
  std::ranges::transform(changes, shares.begin(), &Change::share);
  const Change& change = changes[roulette(shares, stream)];

  const auto apply = [&](LinkGene& link) {
    // Weights of genomes that other searches than NEAT have made may lie beyond the limit.
    const double limit = std::max(weight_limit, std::abs(link.weight));
    link.weight =
        change.reset ? stream.uniform(-weight_limit, weight_limit)
                     : std::clamp(link.weight + stream.uniform(-settings.jiggle_limit, settings.jiggle_limit),
                                  -limit, limit);
  };
  bool any = false;
  for (LinkGene& link : genome.links) {
    if (!stream.chance(change.probability)) continue;
    apply(link);
    any = true;
  }
  if (!any) apply(genome.links[stream.below(static_cast<std::uint32_t>(genome.links.size()))]);
  return true;
}

}  // namespace amble::neat
