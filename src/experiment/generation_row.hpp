#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "amble/neat/population.hpp"
#include "amble/record/trajectory.hpp"
#include "amble/search/search.hpp"

namespace amble::experiment {

/// One line of generations.csv. All columns but the last four (times) are the same bits for any number of
/// workers.
struct GenerationRow {
  int generation = 0;
  double best_m = 0.0, best_so_far_m = 0.0, mean_m = 0.0, median_m = 0.0;
  neat::PopulationStatistics population;
  int best_hidden = 0, best_links = 0;  ///< of this generation's best genome
  int fell = 0, diverged = 0;
  std::optional<search::NoveltyStatistics> novelty;  ///< nothing, and so empty cells, for other searches
  std::uint64_t evaluations = 0, steps = 0;          ///< of this generation
  double wall_s = 0.0;                               ///< since the row before, files included
  double physics_s = 0.0;                            ///< of which in the engine, mean over the workers
  double referees_s = 0.0;                           ///< of which for the trials of referees
  double outside_s = 0.0;                            ///< of which for anything else
};

/// Names of the columns, one line.
std::string csv_header();
std::string csv_line(const GenerationRow& row);

/// The columns that come from the trials: best, mean, median, fell, diverged.
void summarise_trials(std::span<const double> distances_m, std::span<const record::Trajectory> trajectories,
                      GenerationRow& row);

}  // namespace amble::experiment
