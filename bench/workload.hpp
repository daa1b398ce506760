#pragma once

#include <string>
#include <vector>

#include "amble/experiment/config.hpp"
#include "amble/neat/genome.hpp"

namespace amble::bench {

/// configs/authors/supg-objective.toml with overrides.
experiment::Config authors_config(std::vector<std::string> assignments = {});

/// Genomes of the size that evolution ends with (Morse et al. 2013, sec. 5: 6.4 hidden nodes, 39.7 links): a
/// population bred at random, with structural mutations made frequent, until its mean is there.
std::vector<neat::Genome> evolved_genomes(int count, int inputs, int outputs);

}  // namespace amble::bench
