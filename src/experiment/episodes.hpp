#pragma once

#include <span>
#include <vector>

#include "amble/experiment/evaluator.hpp"
#include "amble/trial/noise_settings.hpp"

namespace amble::experiment {

/// The objective of a genome from the scores (at least one) of its episodes.
double objective(trial::EpisodeScore combined, std::span<const double> scores);

/// The objective of each genome of a generation, by the problem's score; Morse et al. 2013, sec. 4: m.
std::vector<double> objectives(const Problem& problem, const GenerationResult& result);

}  // namespace amble::experiment
