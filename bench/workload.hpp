#pragma once

#include <functional>
#include <string>
#include <vector>

#include "amble/experiment/config.hpp"
#include "amble/neat/genome.hpp"

namespace amble::bench {

/// configs/authors/supg-objective.toml with overrides.
experiment::Config authors_config(std::vector<std::string> assignments = {});

/// Genomes of the size at the end of evolution (Morse et al. 2013, sec. 5: 6.4 hidden nodes, 39.7 links): a
/// population bred at random, with structural mutations made frequent, until its mean is there.
std::vector<neat::Genome> evolved_genomes(int count, int inputs, int outputs);

/// Measures what AVX2 alone gives, on processors that have AVX-512 too; elsewhere does nothing.
void without_avx512(const std::function<void()>& measure);

}  // namespace amble::bench
