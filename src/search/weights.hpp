#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "amble/core/check.hpp"
#include "amble/neat/genome.hpp"

namespace amble::search {

/// The weights of a genome's links, in their order: a CPPN that does not grow as a vector.
inline std::vector<double> weights_of(const neat::Genome& genome) {
  std::vector<double> weights;
  weights.reserve(genome.links.size());
  for (const neat::LinkGene& link : genome.links) weights.push_back(link.weight);
  return weights;
}

/// As many weights as the genome has links.
inline void set_weights(neat::Genome& genome, std::span<const double> weights) {
  AMBLE_CHECK(weights.size() == genome.links.size(), "a weight for each link");
  for (std::size_t link = 0; link < weights.size(); ++link) genome.links[link].weight = weights[link];
}

}  // namespace amble::search
