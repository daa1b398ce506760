#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "amble/experiment/problem.hpp"
#include "amble/record/trajectory.hpp"

namespace amble::experiment {

struct GenerationResult {
  std::vector<record::Trajectory> trajectories;  ///< in the order of the genomes
  std::uint64_t steps = 0;
  double physics_s = 0.0;  ///< time in the engine, mean over the workers
};

/// Evaluates populations on several threads, each with an engine and a batch of controllers of its own. Which
/// worker evaluates what depends on timing; the results do not.
class Evaluator {
 public:
  /// `jobs` >= 1 workers. `path_stride`: see trial::Protocol. The problem must outlive the evaluator.
  Evaluator(const Problem& problem, int path_stride, int jobs);
  ~Evaluator();

  /// Nothing if `stop` was set before all trials had ended.
  std::optional<GenerationResult> evaluate(std::span<const neat::Genome> genomes,
                                           const std::atomic<bool>& stop);

 private:
  struct Shared;
  std::unique_ptr<Shared> shared_;
};

}  // namespace amble::experiment
