#pragma once

#include "amble/experiment/plan/run_state.hpp"
#include "amble/experiment/problem.hpp"

namespace amble::experiment {

/// Throws UserError if the config's search does not fit the robot, or could need more memory than this
/// process may use, which could otherwise kill it after hours.
void check_search(const Config& config, const Problem& problem);

}  // namespace amble::experiment
