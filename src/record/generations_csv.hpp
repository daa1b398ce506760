#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace amble::record::column {

/// Columns of generations.csv (docs/FORMATS.md) that every run has. Between `steps` and `wall_s` there are
/// those of its search.
inline constexpr std::string_view generation = "generation";
/// Objective: best of the generation and of the run so far, mean and median. By default a distance, m.
inline constexpr std::string_view best = "best", best_so_far = "best_so_far", mean = "mean",
                                  median = "median";
/// What the run's champion so far typically does: median and quartiles of its objective in trials of their
/// own, and the share of them in which it fell.
inline constexpr std::string_view typical = "typical", typical_lower = "typical_lower",
                                  typical_upper = "typical_upper", typical_fell = "typical_fell";
/// The generation's best genome: hidden nodes, and links that are enabled.
inline constexpr std::string_view best_hidden = "best_hidden", best_links = "best_links";
/// Trials that ended so.
inline constexpr std::string_view fell = "fell", diverged = "diverged";
/// This generation's genomes, and simulation steps.
inline constexpr std::string_view evaluations = "evaluations", steps = "steps";
/// Wall time since the line before, and what of it was neither physics nor referees, s.
inline constexpr std::string_view wall_s = "wall_s", outside_s = "outside_s";

}  // namespace amble::record::column

namespace amble::record {

/// The columns of a run's generations.csv that figures need, one element per generation. All have the same
/// length.
struct Generations {
  std::vector<double> generation;
  std::vector<double> best, mean, median;  ///< objective; best of the generation
  std::vector<double> evaluations, steps;  ///< of this generation; simulation steps
  std::vector<double> best_so_far;         ///< objective of the run's champion; may be empty
  /// What that champion typically does: median and quartiles of the objective, share of falls; may be empty.
  std::vector<double> typical, typical_lower, typical_upper, typical_fell;
  /// Columns of NEAT; empty for searches without. threshold: compatibility threshold of the speciation.
  std::vector<double> species, threshold, mean_hidden, mean_links;
  /// Columns of novelty search; empty for runs without.
  std::vector<double> archive, novelty_threshold, best_novelty;
  /// Columns of MAP-Elites; empty for other searches. coverage: share of the cells that are filled.
  std::vector<double> coverage, qd_score, map_best, entered, improved, reevaluated;
  /// Where the time went, s; all but wall_s may be empty.
  std::vector<double> wall_s, physics_s, decode_s, control_s, waiting_s, search_s, referees_s, files_s;

  std::size_t count() const { return generation.size(); }
};

/// Whether the best of generation `index` became the run's champion: best_so_far changes there, or, without
/// that column, it is better than all before.
bool keeps_champion(const Generations& generations, std::size_t index);

/// Reads generations.csv by the names in its header row; other columns are ignored. Throws UserError:
/// ExitCode::io for a file that cannot be read, ExitCode::bad_file for one that is not such a table
/// ("FILE:LINE: column 'best' …").
Generations read_generations(const std::filesystem::path& path);

/// The same from text; `name` is the file's name in messages.
Generations parse_generations(std::string_view text, const std::string& name);

}  // namespace amble::record
