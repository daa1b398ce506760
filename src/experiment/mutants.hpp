#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "amble/experiment/problem.hpp"
#include "amble/neat/genome.hpp"
#include "amble/neat/settings.hpp"
#include "amble/record/mutant.hpp"

namespace amble::experiment {

struct MutantSettings {
  int count = 200;   ///< mutants, ≥ 1
  int episodes = 1;  ///< trials of each genome under noise unseen during evolution; without noise one is made
};

/// What becomes of a genome's walk by one mutation (neat::mutate with `neat`), `count` times over: how much
/// of the score is kept and how far the gait changes, the two sides of evolvability (Tarapore & Mouret,
/// Information Sciences 313, 2015). Parent and mutants meet the same trials; scores and duty factors are
/// means over them. Mutant i depends on the genome, `seed` and i alone, and the result on no number of
/// `jobs`. Of a genome whose own score is 0, mutants keep nothing. Nothing if `stop` was set.
std::optional<std::vector<record::Mutant>> try_mutants(const Problem& problem, const neat::Settings& neat,
                                                       const neat::Genome& genome, std::int64_t seed,
                                                       const MutantSettings& settings, int jobs,
                                                       const std::atomic<bool>& stop);

}  // namespace amble::experiment
