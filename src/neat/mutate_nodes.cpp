#include <algorithm>
#include <vector>

#include "amble/neat/mutation.hpp"
#include "amble/neat/roulette.hpp"

namespace amble::neat {

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

}  // namespace amble::neat
