#pragma once

#include <cstdint>
#include <vector>

#include "amble/experiment/run_folder.hpp"
#include "amble/experiment/run_state.hpp"

namespace amble::experiment {

/// What an interrupted run goes on from.
struct Recovery {
  RunState state;
  std::vector<std::uint64_t> log_bytes;  ///< how much of each of the search's logs belongs to it
};

/// Reads it from the newest checkpoint of a run folder that is whole, as are the files that it counts on: a
/// process may have been killed after writing a checkpoint and before naming it. Such a one is then given its
/// name. Throws UserError: no sound checkpoint or log, or the best champion's file is gone or another one.
Recovery recover(const RunPaths& paths, const Config& config, const Problem& problem);

}  // namespace amble::experiment
