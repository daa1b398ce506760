#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "amble/experiment/plan/stage_times.hpp"
#include "amble/record/trajectory.hpp"
#include "amble/score/typical.hpp"
#include "amble/search/metric.hpp"

namespace amble::experiment {

/// One line of generations.csv (record/generation_columns.hpp). All columns before wall_s, where the times
/// begin, are the same bits for any number of workers.
struct GenerationRow {
  int generation = 0;
  double best = 0.0, best_so_far = 0.0, mean = 0.0, median = 0.0;  ///< objective
  score::Typical typical;                    ///< of the champion so far: objective, running_trials trials
  int best_hidden = 0, best_links = 0;       ///< of this generation's best genome
  int fell = 0, diverged = 0;                ///< trials
  std::uint64_t evaluations = 0, steps = 0;  ///< of this generation
  std::vector<search::Metric> search;        ///< columns of the search
  double wall_s = 0.0;                       ///< since the row before
  StageTimes times;                          ///< part of it; files_s is of the row before

  double outside_s() const { return wall_s - times.physics_s - times.referees_s; }
  /// The search's metric of this name; nothing if it has none.
  std::optional<double> metric(std::string_view name) const;
};

/// Names of the columns for a search with these metrics, one line.
std::string csv_header(std::span<const search::Metric> search);
/// The row under a header: csv_header() of its search, or that of an earlier build, which lacked some
/// columns. AMBLE_CHECK: it names no other columns (unknown_column).
std::string csv_line(const GenerationRow& row, std::string_view header);
/// The first column of a header that a search with these metrics does not have; empty: none.
std::string unknown_column(std::string_view header, std::span<const search::Metric> search);

/// The columns that come from the trials: best, mean, median, fell, diverged.
void summarise_trials(std::span<const double> objectives, std::span<const record::Trajectory> trajectories,
                      GenerationRow& row);

}  // namespace amble::experiment
