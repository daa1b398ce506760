#pragma once

#include <string>
#include <vector>

#include "amble/report/report.hpp"
#include "amble/report/rows_figure.hpp"

namespace amble::report {

/// Rows of figure 8 of Morse et al. 2013: distance (or score) in evolution, all conditions that have runs.
std::vector<StripRow> training_rows(const Report& report);
/// Rows of their figure 9: distance in a test below that in evolution (of conditions in which that is a
/// distance), all conditions that have the test.
std::vector<StripRow> test_rows(const Report& report, const std::string& test);

struct FigureFile {
  std::string name;  ///< "distance.svg"
  std::string svg;   ///< with its style
};

/// Every figure of the page as a file of its own, laid out for paper. Figures without data are left out.
std::vector<FigureFile> figure_files(const Report& report);

}  // namespace amble::report
