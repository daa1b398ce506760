#pragma once

#include <cstdint>
#include <vector>

#include "amble/experiment/run_folder.hpp"
#include "amble/experiment/run_state.hpp"

namespace amble::experiment {

/// The state from which an interrupted run continues.
struct Recovery {
  RunState state;
  std::vector<std::uint64_t> log_bytes;  ///< length of each of the search's logs at that state
};

/// Reads it from the newest checkpoint of a run folder that is complete, as are the files that it refers to.
/// A process may have been killed after writing a checkpoint and before renaming it; it is then renamed.
/// Throws UserError: no valid checkpoint or log, or the best champion's file is missing or another one.
Recovery recover(const RunPaths& paths, const Config& config, const Problem& problem);

}  // namespace amble::experiment
