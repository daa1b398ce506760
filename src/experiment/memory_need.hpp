#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "amble/experiment/config.hpp"
#include "amble/experiment/problem.hpp"

namespace amble::experiment {

/// How much memory a process may use without being killed: four fifths of the machine's or, where that is
/// less, of the smallest limit of the process (ulimit), its control group and the groups above (cgroup v2,
/// memory.max).
/// `process_groups` and `groups` are /proc/self/cgroup and the folder where the groups are mounted; without
/// them, or without a limit, the machine's memory counts.
double usable_memory_bytes(const std::filesystem::path& process_groups = "/proc/self/cgroup",
                           const std::filesystem::path& groups = "/sys/fs/cgroup");

/// What a generation keeps in memory at least: its genomes and the trajectories of all their trials, and
/// those of the generation before.
struct MemoryNeed {
  double bytes = 0.0;
  std::string what;               ///< "population.size = 300 genomes × …": the factors and their settings
  std::vector<std::string> keys;  ///< of the settings that make it large, the first one first
};
MemoryNeed memory_of_generation(const Config& config, const Problem& problem);

/// To be thrown where the system has refused memory: says what was asked for.
UserError out_of_memory(const Config& config, const Problem& problem);

}  // namespace amble::experiment
