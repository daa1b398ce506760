#pragma once

#include <string>
#include <string_view>

#include "amble/figures/figure_size.hpp"
#include "amble/report/report.hpp"

namespace amble::report {

/// Whether some run has mutants in that test.
bool has_mutants(const Report& report, std::string_view test);

/// Evolvability signatures (Tarapore & Mouret 2015): a small picture per condition, how many mutants keep how
/// much of the score (to the right) with how different a gait (up), darker where there are more; a line where
/// mutants begin to be viable. All have the same axes; what lies beyond them is in the outermost cells. An
/// <svg> element. There must be a mutant.
std::string mutants_figure(const Report& report, const std::string& test, figures::FigureSize layout);

}  // namespace amble::report
