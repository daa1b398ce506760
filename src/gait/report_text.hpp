#pragma once

#include <string>
#include <string_view>

#include "amble/gait/report.hpp"

namespace amble::gait {

/// The first bytes of every report_json().
inline constexpr std::string_view report_json_start = "{\n  \"format\": \"amble-gait\"";
/// A JSON document, "format": "amble-gait" (docs/FORMATS.md).
std::string report_json(const Report& report);

/// A table of plain text.
std::string report_table(const Report& report);

/// A few lines of plain text: name, stride and duty factor, phases, Froude number, cost of transport.
std::string report_summary(const Report& report);

}  // namespace amble::gait
