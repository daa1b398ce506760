#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "amble/experiment/evaluator.hpp"
#include "amble/experiment/plan/told_generation.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/experiment/problem/evaluation_settings.hpp"
#include "amble/experiment/trial_memory.hpp"
#include "amble/score/behaviour.hpp"
#include "amble/search/evaluation.hpp"

namespace amble::experiment {

/// A generation after all its trials.
struct EvaluatedGeneration {
  GenerationResult result;         ///< of the trials that every genome has; steps and times of all trials
  std::vector<double> objectives;  ///< of all trials of each genome, by the problem's score; default m
  std::vector<std::size_t> finalists = {};  ///< who had further trials, in order; empty: nobody
  std::vector<std::size_t> diverged = {};   ///< of whom a further trial diverged, in order

  /// The first of those with the largest objective; of the finalists, if there are any: others may count as
  /// much as the worst of them.
  std::size_t best() const;
};

/// What is kept of a generation for the next. Not thread safe.
struct GenerationMemory {
  GenerationGround ground;
  TrialMemory trials;
};

/// The generation's trials: one per genome and episode of the problem's noise, then those of the finalists
/// (sequential halving in two rounds; Karnin, Koren & Somekh, ICML 2013). A genome that was not tried again
/// counts at most as much as the worst of those that were: what it reached beyond may be luck. Nothing if
/// `stop` was set before all trials had ended. `memory` is that of the calls before for this problem.
std::optional<EvaluatedGeneration> evaluate_generation(Evaluator& evaluator, const Problem& problem,
                                                       const EvaluationSettings& settings,
                                                       GenerationMemory& memory, std::int64_t seed,
                                                       int generation, std::span<const neat::Genome> genomes,
                                                       const std::atomic<bool>& stop);

ToldGeneration told(const EvaluatedGeneration& evaluated, const score::Behaviour& behaviour);

/// Indices of the best share of the genomes, at least one, ascending; of equal objectives the first.
std::vector<std::size_t> finalists_of(std::span<const double> objectives, double share);

}  // namespace amble::experiment
