#pragma once

#include <string>

#include "amble/figures/figure_size.hpp"
#include "amble/report/report.hpp"
#include "amble/report/typical.hpp"

namespace amble::report {

/// A panel for each condition: every champion's typical distance against the amount of disturbance, and the
/// condition's median with its interval; grey the medians of the others. An <svg> element.
std::string typical_figure(const Report& report, const TypicalTable& table, figures::FigureSize layout);

}  // namespace amble::report
