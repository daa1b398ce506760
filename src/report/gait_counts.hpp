#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "amble/report/study_data.hpp"

namespace amble::report {

/// Shown for runs without a gait name, e.g. of robots with eight legs.
inline constexpr std::string_view nameless_gait = "no name";

/// Whether the name is one of a regular gait (docs/GAIT.md).
bool is_regular(std::string_view gait);

/// Gaits of one condition's champions in one test.
struct GaitCounts {
  std::string condition;
  std::size_t n = 0;  ///< runs that have the test
  /// Gaits that occur, in the order of docs/GAIT.md, each with its number of runs; irregular and nameless
  /// ones last.
  std::vector<std::pair<std::string, std::size_t>> runs;

  std::size_t count(std::string_view gait) const;
};

GaitCounts count_gaits(const StudyData& data, std::string_view test, std::string_view condition);

/// One test with all conditions that have it.
struct GaitTable {
  std::string test;
  std::vector<std::string> gaits;  ///< that occur in any condition
  std::vector<GaitCounts> rows;
};

/// All tests that any run has.
std::vector<GaitTable> gait_tables(const StudyData& data);

}  // namespace amble::report
