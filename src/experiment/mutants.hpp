#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "amble/experiment/problem.hpp"
#include "amble/neat/genome.hpp"
#include "amble/neat/settings.hpp"
#include "amble/record/mutant.hpp"

namespace amble::experiment {

/// A genome and what mutations make of it.
struct MutationOutcome {
  double score = 0.0;  ///< of the genome itself: mean over the trials
  std::vector<record::Mutant> mutants;
};

/// What becomes of a genome's walk by one mutation (neat::mutate with `neat`), `count` times over: how much
/// of the score is kept and how far the gait changes, the two sides of evolvability (Tarapore & Mouret,
/// Information Sciences 313, 2015). The genome and its mutants meet the same trials, one per key, which are
/// on the same ground; without keys one trial without noise. Scores and duty factors are means over the
/// trials. Mutant i depends on the genome, the settings, `seed` and i alone, not on `count` or the number of
/// `jobs`. Nothing if `stop` was set.
std::optional<MutationOutcome> try_mutants(const Problem& problem, const neat::Settings& neat,
                                           const neat::Genome& genome, int count, std::int64_t seed,
                                           std::span<const trial::ScenarioKey> trials, int jobs,
                                           const std::atomic<bool>& stop);

}  // namespace amble::experiment
