#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "amble/experiment/problem/episode_set.hpp"
#include "amble/experiment/problem/problem.hpp"
#include "amble/record/trajectory.hpp"
#include "amble/score/behaviour.hpp"
#include "amble/search/evaluation.hpp"
#include "amble/trial/scenario.hpp"

namespace amble::experiment {

/// The key of trial n of a set, and of its ground: of any genome, for sets that no generation has of its own.
trial::ScenarioKey episode_key(EpisodeSet set, std::int64_t seed, std::uint32_t n = 0);

/// What each trial of a genome counts in evolution: the problem's score, with its factor for falls.
std::vector<double> credited_scores(const Problem& problem, std::span<const record::Trajectory> trials);
/// The objective of each genome, from its trials, `episodes` of each in a row.
std::vector<double> objectives(const Problem& problem, std::span<const record::Trajectory> trials,
                               std::size_t episodes);

/// What must be measured for TrialResult::tracking: nothing without commands.
record::Measures tracking_measures(const Problem& problem);

/// What a search is told of a generation. May be moved, not copied: the evaluations refer to the behaviours.
struct ToldGeneration {
  std::vector<std::vector<float>> behaviours;
  std::vector<search::Evaluation> evaluations;  ///< by genome; not viable: a trial of it diverged
};
ToldGeneration told(std::span<const record::Trajectory> trials, std::size_t episodes,
                    std::span<const double> objectives, const score::Behaviour& behaviour);

}  // namespace amble::experiment
