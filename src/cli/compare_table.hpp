#pragma once

#include <string>
#include <vector>

#include "amble/cli/compare_maps.hpp"
#include "amble/experiment/referees.hpp"

namespace amble::cli {

/// One champion with trials of one length in several engines.
struct ComparedChampion {
  std::string name;
  std::string home;  ///< the engine in which it evolved
  double trial_s = 0.0;
  std::string under;  ///< what disturbs the trials: "at the level milli", "without noise"
  std::vector<experiment::EngineResult> in;  ///< including its home; the same engines in every row
};

/// Rows of equally many cells as an aligned table, or as one in Markdown; the first row is its head.
std::string aligned_text(const std::vector<std::vector<std::string>>& lines);
std::string markdown_text(const std::vector<std::vector<std::string>>& lines);

/// An aligned table; the last lines summarise several champions: per engine the median distance,
/// and how many champions kept at least 70 % of what they walk at home. Of several trials of a champion
/// the median distance counts.
std::string compare_text(const std::vector<ComparedChampion>& rows);
/// The same as a table in Markdown.
std::string compare_markdown(const std::vector<ComparedChampion>& rows);
/// An array, one object per row (docs/FORMATS.md); a row of a run with a map has it.
std::string compare_json(const std::vector<ComparedChampion>& rows, const std::vector<ComparedMap>& maps);

/// "3.412 m, 87 %, fell at 7.31 s": distance, share of `home_m`, and the outcome if it ended early.
std::string result_text(const experiment::TrialResult& result, double home_m);

}  // namespace amble::cli
