#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "amble/core/process.hpp"
#include "amble/experiment/plan/generation_row.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/record/trajectory.hpp"

namespace amble::experiment {

struct GenerationResult {
  /// In the order of the genomes, and for each in the order of its episodes.
  std::vector<record::Trajectory> trajectories;
  std::size_t episodes = 1;  ///< trials per genome
  std::uint64_t steps = 0;
  StageTimes times;  ///< the stages of workers

  std::span<const record::Trajectory> of_genome(std::size_t index) const {
    return std::span(trajectories).subspan(index * episodes, episodes);
  }
};

/// Evaluates populations on several threads, each with an engine and a batch of controllers of its own. Which
/// worker evaluates which genome depends on timing; the results do not. In a process that was forked from
/// the one that made it, it can only be destroyed.
class Evaluator {
 public:
  /// `jobs` ≥ 1 workers. `path`: the sampling of paths; `measures`: those that the problem's score does not
  /// need itself. The problem must outlive the evaluator.
  Evaluator(const Problem& problem, const record::PathSampling& path, int jobs,
            const record::Measures& measures = {});
  ~Evaluator();

  /// False in a process that was forked from the one that made it.
  bool works_here() const { return made_in_.is_this(); }

  /// One trial per genome and scenario; without scenarios, one without noise per genome. `ground`: null for
  /// the plane. Nothing if `stop` was set before all trials had ended.
  std::optional<GenerationResult> evaluate(std::span<const neat::Genome> genomes,
                                           const std::atomic<bool>& stop,
                                           std::span<const trial::Scenario> scenarios = {},
                                           std::shared_ptr<const ground::Ground> ground = nullptr);

 private:
  struct Shared;
  std::unique_ptr<Shared> shared_;
  MakingProcess made_in_;
};

}  // namespace amble::experiment
