#pragma once

#include <string>

#include "amble/figures/figure_size.hpp"
#include "amble/report/report.hpp"

namespace amble::report {

/// A small picture per condition: median and quartiles of the best distance over generations, behind them in
/// grey the medians of all others. An <svg> element. There must be a curve.
std::string curves_figure(const Report& report, figures::FigureSize layout);

}  // namespace amble::report
