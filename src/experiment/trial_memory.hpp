#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "amble/experiment/evaluator.hpp"

namespace amble::experiment {

/// What the trials of a generation were drawn by: beside the genome they depend on nothing else.
struct TrialDraw {
  std::int64_t seed = 0;  ///< of the run
  int generation = 0;     ///< by whose number noise and ground are drawn; 0 where trials do not vary
  friend bool operator==(const TrialDraw&, const TrialDraw&) = default;
};

/// Keeps the trials of a generation for the next one: elites, and offspring that no mutation met, need not be
/// tried again. Trials of equal genomes are equal to the bit, so no result depends on it. Not thread safe.
class TrialMemory {
 public:
  /// Evaluator::evaluate(), but only one of equal genomes is tried, and none that was among those of the call
  /// before if that had the same `draw`, which scenarios and ground are drawn by. Must always be given
  /// evaluators of one problem that measure alike. The steps of the result are those of the trials of all
  /// genomes, tried or not.
  std::optional<GenerationResult> evaluate(Evaluator& evaluator, std::span<const neat::Genome> genomes,
                                           const std::atomic<bool>& stop, const TrialDraw& draw,
                                           std::span<const trial::Scenario> scenarios,
                                           const std::shared_ptr<const ground::Ground>& ground);

 private:
  /// Of the call before; nothing before the first one.
  std::optional<TrialDraw> draw_;
  std::vector<neat::Genome> genomes_;
  std::vector<record::Trajectory> trajectories_;  ///< genome by genome, and for each episode by episode
};

}  // namespace amble::experiment
