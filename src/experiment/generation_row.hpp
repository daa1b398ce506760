#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "amble/experiment/stage_times.hpp"
#include "amble/neat/population.hpp"
#include "amble/record/trajectory.hpp"
#include "amble/search/search.hpp"

namespace amble::experiment {

/// One line of generations.csv. All columns before wall_s, where the times begin, are the same bits for any
/// number of workers.
struct GenerationRow {
  int generation = 0;
  double best_m = 0.0, best_so_far_m = 0.0, mean_m = 0.0, median_m = 0.0;
  neat::PopulationStatistics population;
  int best_hidden = 0, best_links = 0;  ///< of this generation's best genome
  int fell = 0, diverged = 0;
  std::optional<search::NoveltyStatistics> novelty;  ///< nothing, and so empty cells, for other searches
  std::uint64_t evaluations = 0, steps = 0;          ///< of this generation
  double wall_s = 0.0;                               ///< since the row before
  StageTimes times;                                  ///< of which; files are those of the row before

  double outside_s() const { return wall_s - times.physics_s - times.referees_s; }
};

/// Names of the columns, one line.
std::string csv_header();
std::string csv_line(const GenerationRow& row);

/// The columns that come from the trials: best, mean, median, fell, diverged.
void summarise_trials(std::span<const double> distances_m, std::span<const record::Trajectory> trajectories,
                      GenerationRow& row);

}  // namespace amble::experiment
