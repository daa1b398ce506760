#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "amble/experiment/champion.hpp"

namespace amble::experiment {

struct RefereeOptions {
  std::optional<double> seconds = {};  ///< length of the trials; nothing: as in the problem
  int jobs = 1;                        ///< more than 1: the engines work side by side
};

/// Tries a genome, without noise, in each of the engines. Nothing if `stop` was set before all were done.
/// Throws UserError for an engine that is unknown or cannot simulate the robot.
std::optional<std::vector<Refereed>> ask_referees(const Problem& problem, const neat::Genome& genome,
                                                  const std::vector<std::string>& engines,
                                                  const RefereeOptions& options,
                                                  const std::atomic<bool>& stop);

}  // namespace amble::experiment
