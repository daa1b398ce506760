#pragma once

#include "amble/core/random.hpp"
#include "amble/neat/genome.hpp"
#include "amble/neat/innovations.hpp"
#include "amble/neat/settings.hpp"

namespace amble::neat {

/// A genome without hidden nodes: each link from bias or an input to an output is there with
/// initial_link_probability, its weight uniform within the limits. `inputs` does not count the bias. The link
/// from node f to output number o has innovation number f × outputs + o, if `innovations` is new or knows
/// initial genomes only.
Genome initial_genome(const GenomeSettings& settings, int inputs, int outputs, Innovations& innovations,
                      Stream& stream);

}  // namespace amble::neat
