#include "amble/neat/initial_genome.hpp"

namespace amble::neat {

Genome initial_genome(const GenomeSettings& settings, int inputs, int outputs, Innovations& innovations,
                      Stream& stream) {
  const auto first_output = static_cast<std::uint32_t>(1 + inputs);
  const auto end = first_output + static_cast<std::uint32_t>(outputs);
  Genome genome;
  genome.nodes.push_back({.id = 0, .kind = NodeKind::bias, .activation = Activation::linear});
  for (std::uint32_t id = 1; id < first_output; ++id)
    genome.nodes.push_back({.id = id, .kind = NodeKind::input, .activation = Activation::linear});
  for (std::uint32_t id = first_output; id < end; ++id)
    genome.nodes.push_back({.id = id, .kind = NodeKind::output, .activation = settings.output_activation});

  for (std::uint32_t from = 0; from < first_output; ++from)
    for (std::uint32_t to = first_output; to < end; ++to) {
      // Every possible link is numbered, also those that this genome does not have.
      const std::uint32_t innovation = innovations.link(from, to);
      if (!stream.chance(settings.initial_link_probability)) continue;
      insert_link(genome, {.innovation = innovation,
                           .from = from,
                           .to = to,
                           .weight = stream.uniform(-settings.weight_limit, settings.weight_limit),
                           .enabled = true});
    }
  return genome;
}

}  // namespace amble::neat
