#pragma once

#include <string>
#include <utility>
#include <vector>

#include "amble/experiment/champion.hpp"
#include "amble/experiment/config.hpp"
#include "amble/neat/population.hpp"

namespace amble::presentation {

/// A first genome of the preset `authors`, in the batch engine and trials of 1 s; `settings` as --set has
/// them.
inline experiment::Champion champion_of(std::vector<std::string> settings) {
  settings.insert(settings.end(), {"engine=batch", "trial.duration_s=1"});
  const auto config =
      experiment::load_config(AMBLE_SOURCE_DIR "/configs/authors/supg-objective.toml",
                              {.assignments = std::move(settings), .seed = 5, .generations = 1});
  experiment::Champion champion{.experiment = config.name,
                                .seed = 5,
                                .problem = experiment::Problem::make(config, experiment::load_robot(config)),
                                .genome = {},
                                .result = {},
                                .trace = {},
                                .episodes = {}};
  champion.genome =
      neat::Population(config.neat, champion.problem.cppn_inputs(), champion.problem.cppn_outputs(), true, 5)
          .genomes()[0];
  return champion;
}

}  // namespace amble::presentation
