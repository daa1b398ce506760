#pragma once

#include <string>
#include <vector>

#include "amble/experiment/referees.hpp"
#include "amble/experiment/repertoire.hpp"
#include "amble/presentation/comparison.hpp"

namespace amble::cli {

/// Rows of equally many cells as an aligned table, or as one in Markdown; the first row is its head.
std::string aligned_text(const std::vector<std::vector<std::string>>& lines);
std::string markdown_text(const std::vector<std::vector<std::string>>& lines);

/// An aligned table; the last lines summarise several champions: per engine the median distance,
/// and how many champions kept at least 70 % of what they walk at home. Of several trials of a champion
/// the median distance counts.
std::string compare_text(const std::vector<presentation::ComparedChampion>& rows);
/// The same as a table in Markdown.
std::string compare_markdown(const std::vector<presentation::ComparedChampion>& rows);
/// Head and rows of a table of maps.
std::vector<std::vector<std::string>> maps_table(const std::vector<experiment::ComparedMap>& maps);

/// "3.412 m, 87 %, fell at 7.31 s": distance, share of `home_m`, and the outcome if it ended early.
std::string result_text(const experiment::TrialResult& result, double home_m);

}  // namespace amble::cli
