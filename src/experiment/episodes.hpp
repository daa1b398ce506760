#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "amble/experiment/evaluator.hpp"
#include "amble/trial/noise_settings.hpp"
#include "amble/trial/scenario.hpp"

namespace amble::experiment {

/// The objective of a genome from the scores (at least one) of its episodes.
double objective(trial::EpisodeScore combined, std::span<const double> scores);

/// The trials numbered `first`, `first` + 1, … of those unseen during evolution, for `count` trials of any
/// genome; none for a problem without noise. `ground` is that of unseen_key(seed).
std::vector<trial::Scenario> unseen_scenarios(const Problem& problem, std::int64_t seed, int first, int count,
                                              const ground::Ground* ground);
/// The key of their ground, and of the first of them.
trial::ScenarioKey unseen_key(std::int64_t seed);
/// The same of the trials that decide on champions, of which neither evolution nor unseen_scenarios() has
/// any.
trial::ScenarioKey judging_key(std::int64_t seed);
/// The same of the trials that tell what a champion typically does (TypicalTrials): none of them decides on
/// anything.
trial::ScenarioKey typical_key(std::int64_t seed);

/// What each trial of a genome counts in evolution: the problem's score, with its factor for falls.
std::vector<double> credited_scores(const Problem& problem, std::span<const record::Trajectory> trials);

/// The objective of each genome of a generation, by the problem's score; Morse et al. 2013, sec. 4: m.
std::vector<double> objectives(const Problem& problem, const GenerationResult& result);

}  // namespace amble::experiment
