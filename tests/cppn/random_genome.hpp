#pragma once

#include <set>
#include <utility>

#include "amble/core/random.hpp"
#include "amble/neat/genome.hpp"

namespace amble::cppn {

struct GenomeShape {
  int inputs = 3, outputs = 2, hidden = 7, links = 40;
  bool cycles = true;  ///< else every link goes from a lower to a higher place in a random order of the
                       ///< nodes, outputs included
  double weight_limit = 1.5;
};

/// A genome with bias, inputs and outputs as NEAT makes them (ids 0, 1, …), random hidden nodes, and up to
/// shape.links random links of which one in ten is disabled.
inline neat::Genome random_genome(const GenomeShape& shape, Stream& stream) {
  neat::Genome genome;
  std::uint32_t id = 0;
  const auto add = [&](neat::NodeKind kind, int count, bool random_function) {
    for (int i = 0; i < count; ++i)
      genome.nodes.push_back(
          {id++, kind,
           random_function ? static_cast<neat::Activation>(stream.below(4)) : neat::Activation::linear});
  };
  add(neat::NodeKind::bias, 1, false);
  add(neat::NodeKind::input, shape.inputs, false);
  add(neat::NodeKind::output, shape.outputs, true);
  add(neat::NodeKind::hidden, shape.hidden, true);

  const std::uint32_t sources = id, first_target = static_cast<std::uint32_t>(1 + shape.inputs);
  std::vector<std::uint32_t> rank(sources);
  for (std::uint32_t i = 0; i < sources; ++i) rank[i] = i < first_target ? 0 : 1 + stream.below(1000000);
  std::set<std::pair<std::uint32_t, std::uint32_t>> taken;
  for (int i = 0; i < shape.links; ++i) {
    const std::uint32_t from = stream.below(sources),
                        to = first_target + stream.below(sources - first_target);
    if (!shape.cycles && rank[from] >= rank[to]) continue;
    if (!taken.insert({from, to}).second) continue;
    genome.links.push_back({static_cast<std::uint32_t>(i), from, to,
                            stream.uniform(-shape.weight_limit, shape.weight_limit), !stream.chance(0.1)});
  }
  return genome;
}

}  // namespace amble::cppn
