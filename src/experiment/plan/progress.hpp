#pragma once

#include <cstdint>
#include <optional>

#include "amble/score/typical.hpp"

namespace amble::experiment {

/// Progress of a run, all processes that worked on it together.
struct Progress {
  double best = -1.0;  ///< objective of the champion in its evaluation; −1 before the first generation
  int best_generation = -1;  ///< in which the champion was found; −1 before the first
  /// What the champion typically does (objective, running_trials trials); not in checkpoints, as it follows
  /// from the champion. Nothing before the first generation.
  std::optional<score::Typical> typical = {};
  std::uint64_t evaluations = 0;  ///< genomes evaluated, of all generations
  std::uint64_t steps = 0;        ///< simulation steps of their trials
  double wall_s = 0.0;            ///< sum of GenerationRow::wall_s
  std::uint64_t csv_bytes = 0;    ///< length of generations.csv
  std::uint64_t csv_digest = 0;   ///< table_digest() of it; 0: not known
};

}  // namespace amble::experiment
