#pragma once

#include <string>

namespace amble::report {

/// The style sheet of a report's page, after that of graphics::style_sheet(): tables that become cards on
/// phones, verdicts, and the report's figures.
std::string style_sheet();

/// graphics::standalone_svg with the style of the report's figures.
std::string standalone_figure(std::string element);

}  // namespace amble::report
