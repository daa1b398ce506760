#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "amble/record/trajectory.hpp"
#include "amble/score/typical.hpp"
#include "amble/search/evaluation.hpp"

namespace amble::experiment {

/// Wall time of a generation by stage, in seconds; of stages of workers, the mean. The rest is overhead:
/// trajectories, statistics, the champion's re-run except its physics.
struct StageTimes {
  double physics_s = 0.0;   ///< in the engine
  double decode_s = 0.0;    ///< from genomes to controllers
  double control_s = 0.0;   ///< controllers, and noise
  double waiting_s = 0.0;   ///< workers without a trial waited for those that had one
  double search_s = 0.0;    ///< the search: from evaluations to the next candidates
  double referees_s = 0.0;  ///< trials of champions in the referees
  double files_s = 0.0;     ///< written and synced
};

/// One of the stages, by name.
struct Stage {
  std::string_view column;      ///< its name in generations.csv
  std::string_view name;        ///< as displayed
  double StageTimes::*seconds;  ///< its time
};
/// All stages, in the order of the columns of generations.csv.
inline constexpr std::array<Stage, 7> stages{{
    {"physics_s", "physics", &StageTimes::physics_s},
    {"decode_s", "genomes to controllers", &StageTimes::decode_s},
    {"control_s", "controllers, noise", &StageTimes::control_s},
    {"waiting_s", "waiting for others", &StageTimes::waiting_s},
    {"search_s", "search", &StageTimes::search_s},
    {"referees_s", "referees", &StageTimes::referees_s},
    {"files_s", "files", &StageTimes::files_s},
}};

/// One line of generations.csv (record/generations_csv.hpp). All columns before wall_s, where the times
/// begin, are the same bits for any number of workers.
struct GenerationRow {
  int generation = 0;      ///< from 0
  double best = 0.0,       ///< largest objective of this generation's genomes; m if the score is the distance
      best_so_far = 0.0,   ///< the champion's, in its own evaluation; with champion.episodes it may fall
      mean = 0.0,          ///< mean objective of this generation's genomes
      median = 0.0;        ///< median objective of this generation's genomes
  score::Typical typical;  ///< what the champion so far typically does: objective, in running_trials trials
  int best_hidden = 0,     ///< hidden nodes of this generation's best genome
      best_links = 0;      ///< enabled links of this generation's best genome
  int fell = 0,            ///< trials that ended in a fall, those of finalists not counted
      diverged = 0;        ///< trials that diverged, likewise
  std::uint64_t evaluations = 0,       ///< genomes evaluated in this generation
      steps = 0;                       ///< simulation steps of all their trials
  std::vector<search::Metric> search;  ///< columns of the search (search::Strategy::metrics)
  double wall_s = 0.0;                 ///< since the row before
  StageTimes times;  ///< parts of it; files_s has the time for the files of the row before, too

  /// Wall time not spent in engines: wall_s but for physics and referees, at least 0. With several workers
  /// the best of a generation is tried further while the next one is evaluated, so that parts of a line may
  /// be more than it.
  double outside_s() const { return std::max(0.0, wall_s - times.physics_s - times.referees_s); }
  /// The search's metric of this name; nothing if it has none.
  std::optional<double> metric(std::string_view name) const;
};

/// Names of the columns for a search with these metrics, one line, with its newline.
std::string csv_header(std::span<const search::Metric> search);
/// The row under a header, with its newline: csv_header() of its search, or that of an earlier build, which
/// lacked some columns. AMBLE_CHECK: it names no other columns (unknown_column).
std::string csv_line(const GenerationRow& row, std::string_view header);
/// The first column of a header that a search with these metrics does not have; empty: none.
std::string unknown_column(std::string_view header, std::span<const search::Metric> search);

/// The digest of a run's table after one more line (the header is the first, after 0): of all columns but
/// times, so the same for any number of workers. Never 0.
std::uint64_t table_digest(std::uint64_t before, std::string_view header, std::string_view line);

/// Fills in the columns that come from the trials: best, mean, median; adds to fell and diverged.
/// `objectives`: one per genome, at least one (AMBLE_CHECK).
void summarise_trials(std::span<const double> objectives, std::span<const record::Trajectory> trajectories,
                      GenerationRow& row);

/// How the trials of a run ended, as far as this process made them.
class TrialTally {
 public:
  /// Counts these trials. `full_steps`: length of a trial that nothing ends early.
  void add(std::span<const record::Trajectory> trajectories, int full_steps);

  /// Trials counted.
  std::uint64_t trials() const { return trials_; }
  /// Trials that diverged.
  std::uint64_t diverged() const { return diverged_; }
  /// Why the results mean nothing, as a sentence: at most a tenth of the trials did not diverge, nor fell
  /// within a hundredth of their length. Empty otherwise, and without any trial.
  std::string verdict() const;

 private:
  std::uint64_t trials_ = 0, diverged_ = 0, at_once_ = 0;
};

}  // namespace amble::experiment
