#pragma once

#include <string>
#include <vector>

#include "amble/experiment/referees.hpp"

namespace amble::cli {

/// One champion with trials of one length in several engines.
struct ComparedChampion {
  std::string name;
  std::string home;  ///< the engine in which it evolved
  double trial_s = 0.0;
  std::vector<experiment::EngineResult> in;  ///< including its home; the same engines in every row
};

/// An aligned table; the last lines summarise several champions: per engine the median distance,
/// and how many champions kept at least 70 % of what they walk at home. Of several trials of a champion
/// the median distance counts.
std::string compare_text(const std::vector<ComparedChampion>& rows);
/// The same as a table in Markdown.
std::string compare_markdown(const std::vector<ComparedChampion>& rows);
/// An array, one object per row (docs/FORMATS.md).
std::string compare_json(const std::vector<ComparedChampion>& rows);

/// "3.412 m, 87 %, fell at 7.31 s": distance, share of `home_m`, and the outcome if it ended early.
std::string result_text(const experiment::TrialResult& result, double home_m);

}  // namespace amble::cli
