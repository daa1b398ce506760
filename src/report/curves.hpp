#pragma once

#include <string>
#include <vector>

#include "amble/report/study_data.hpp"

namespace amble::report {

/// Best distance (or score, record::Objective) so far over the generations, over all runs of a condition.
struct BestCurve {
  std::string condition;
  std::size_t n = 0;            ///< runs, at least one
  std::vector<int> generation;  ///< ascending, first and last included; at most 121
  std::vector<double> lower_quartile_m, median_m, upper_quartile_m;  ///< one per generation
};

/// The curves of every condition that has a run. Runs of unlike length count as far as the shortest goes.
std::vector<BestCurve> best_curves(const StudyData& data);

}  // namespace amble::report
