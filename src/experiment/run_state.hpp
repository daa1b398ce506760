#pragma once

#include <memory>

#include "amble/experiment/checkpoint.hpp"
#include "amble/experiment/config.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/search/strategy.hpp"

namespace amble::experiment {

/// A run between two generations: the content of a checkpoint.
struct RunState {
  /// Before the first generation.
  RunState(const Config& config, const Problem& problem);

  Progress progress;
  std::unique_ptr<search::Strategy> strategy;
};

/// Throws UserError if the config's search does not fit the robot, or could need more memory than this
/// process may use, which could otherwise kill it after hours.
void check_search(const Config& config, const Problem& problem);

}  // namespace amble::experiment
