#pragma once

#include <memory>

#include "amble/experiment/plan/checkpoint.hpp"
#include "amble/experiment/plan/config.hpp"
#include "amble/experiment/problem/problem.hpp"
#include "amble/search/strategies.hpp"
#include "amble/search/strategy.hpp"

namespace amble::experiment {

/// What a run searches.
search::SearchSpace space_of(const Config& config, const Problem& problem);

/// A run between two generations: the content of a checkpoint.
struct RunState {
  /// Before the first generation.
  RunState(const Config& config, const Problem& problem);

  Progress progress;
  std::unique_ptr<search::Strategy> strategy;
};

}  // namespace amble::experiment
