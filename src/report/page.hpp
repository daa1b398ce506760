#pragma once

#include <string>

#include "amble/report/report.hpp"

namespace amble::report {

/// One self-contained HTML page, which is well-formed XML too: no network, no scripts.
std::string make_page(const Report& report);

/// The style sheet of a report's page, after that of figures::style_sheet(): tables that become cards on
/// phones, verdicts, and the report's figures.
std::string style_sheet();

/// figures::standalone_svg with the style of the report's figures.
std::string standalone_figure(std::string element);

}  // namespace amble::report
