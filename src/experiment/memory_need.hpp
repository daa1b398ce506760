#pragma once

#include <string>
#include <vector>

#include "amble/experiment/config.hpp"
#include "amble/experiment/problem.hpp"

namespace amble::experiment {

/// What a generation keeps in memory at least: its genomes, and the trajectories of all their trials.
struct MemoryNeed {
  double bytes = 0.0;
  std::string what;               ///< "population.size = 300 genomes × …": the factors and their settings
  std::vector<std::string> keys;  ///< of the settings that make it large, the first one first
};
MemoryNeed memory_of_generation(const Config& config, const Problem& problem);

/// To be thrown where the system has refused memory: says what was asked for.
UserError out_of_memory(const Config& config, const Problem& problem);

}  // namespace amble::experiment
