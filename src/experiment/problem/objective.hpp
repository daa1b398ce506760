#pragma once

#include <span>

#include "amble/trial/noise_settings.hpp"

namespace amble::experiment {

/// The objective of a genome from the scores (at least one) of its episodes.
double objective(trial::EpisodeScore combined, std::span<const double> scores);

}  // namespace amble::experiment
