#pragma once

#include <span>
#include <vector>

#include "amble/experiment/evaluator.hpp"
#include "amble/trial/noise_settings.hpp"

namespace amble::experiment {

/// What the distances (m, at least one) of an evaluation's episodes make of a genome.
double objective_m(trial::EpisodeScore score, std::span<const double> distances_m);

/// The objective of each genome of a generation, m.
std::vector<double> objectives_m(trial::EpisodeScore score, double fall_factor,
                                 const GenerationResult& result);

}  // namespace amble::experiment
