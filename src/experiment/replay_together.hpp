#pragma once

#include <atomic>
#include <optional>
#include <span>
#include <vector>

#include "amble/experiment/champion.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/trial/trial.hpp"

namespace amble::experiment {

/// One of several trials of a genome.
struct TogetherTrial {
  std::optional<trial::ScenarioKey> noise = {};  ///< under the problem's noise; nothing: without any
  trial::Observer* observer = nullptr;           ///< not owned, may be null; of this trial alone
};

/// Several trials of one genome, each of that length, as many at a time as the engine has lanes, on one
/// thread. Results and what observers see are to the bit those of replay() trial by trial. Trials on
/// different uneven ground run one after the other. `measures`: those that the problem does not need itself.
/// Nothing if `stop` was set before the last ended. Throws UserError.
std::optional<std::vector<TrialResult>> replay_together(const Problem& problem, const neat::Genome& genome,
                                                        double seconds, std::span<const TogetherTrial> trials,
                                                        const std::atomic<bool>& stop,
                                                        const record::Measures& measures = {});

}  // namespace amble::experiment
