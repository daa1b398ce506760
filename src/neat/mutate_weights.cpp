#include <algorithm>
#include <array>

#include "amble/neat/mutation.hpp"
#include "amble/neat/roulette.hpp"

namespace amble::neat {
namespace {

/// One way to change weights.
struct Change {
  double share;
  double probability;  ///< of each link; 0: exactly one link
  bool reset;          ///< drawn anew, or else jiggled
};

}  // namespace

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
    link.weight =
        change.reset ? stream.uniform(-weight_limit, weight_limit)
                     : std::clamp(link.weight + stream.uniform(-settings.jiggle_limit, settings.jiggle_limit),
                                  -weight_limit, weight_limit);
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
