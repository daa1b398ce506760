#pragma once

#include <string_view>

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
