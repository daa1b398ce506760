#pragma once

#include <atomic>
#include <optional>

#include "amble/experiment/champion.hpp"
#include "amble/experiment/config.hpp"
#include "amble/experiment/plan/stage_times.hpp"

namespace amble::experiment {

/// A genome of a generation that was better than all before.
struct NewBest {
  int generation = 0;
  int index = 0;  ///< among the generation's candidates
  const neat::Genome& genome;
  std::optional<double> objective = {};  ///< to be reached again; nothing: whatever it reaches
};

/// Runs it again without noise, in the episodes of its evaluation, and in the config's referees, and returns
/// the results. Adds to `times`. Nothing if `stop` was set meanwhile. Throws UserError(differs) if it does
/// not reach its objective again.
std::optional<Champion> try_champion(const Config& config, const Problem& problem, const NewBest& best,
                                     int jobs, StageTimes& times, const std::atomic<bool>& stop);

}  // namespace amble::experiment
