#pragma once

#include <filesystem>
#include <string>

namespace amble::study {

/// A Slurm array job whose tasks are the shards of a study.
struct SlurmJob {
  std::string name;                          ///< other characters than letters, digits, - and _ become -
  std::filesystem::path program, file, out;  ///< absolute: tasks begin in any folder, on any node
  int tasks = 1;                             ///< of the array; shard i of `tasks` each
  int jobs = 1;                              ///< processors of a task
  int per_run = 1;                           ///< of these for each run
  bool discard_runs = false;                 ///< WorkOptions::discard_runs
  std::string plugins = {};  ///< AMBLE_PLUGINS: shared libraries of the study's kinds, split by colons
  int minutes = 60;          ///< time limit of a task; one that needs longer is requeued
};

/// The batch script for sbatch. Each task works on its shard until it is done; a task near its time limit
/// gets USR1 and requeues itself, one that is preempted, or whose node is lost, is requeued by Slurm; all
/// continue from their run folders. A cancelled task is not requeued. Submitting the script again does the
/// rest.
std::string slurm_script(const SlurmJob& job);

}  // namespace amble::study
