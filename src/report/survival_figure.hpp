#pragma once

#include <string>

#include "amble/figures/figure_size.hpp"
#include "amble/report/report.hpp"

namespace amble::report {

/// Kaplan–Meier curves of all conditions in one test: in one picture with their names at the right, or with
/// more than eight, which no colours tell apart, in small pictures. An <svg> element.
std::string survival_figure(const Report& report, const SurvivalTable& table, figures::FigureSize layout);

/// A time with the unit in which the figure has it, e.g. 10800 s as "3 h".
std::string time_text(double time_s);

}  // namespace amble::report
