#include "amble/neat/mutation.hpp"

#include <algorithm>
#include <array>

#include "amble/core/check.hpp"
#include "amble/neat/roulette.hpp"

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

}  // namespace amble::neat
