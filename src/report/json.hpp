#pragma once

#include <string>

#include "amble/report/report.hpp"

namespace amble::report {

inline constexpr std::string_view report_format = "amble-report";
inline constexpr int report_version = 1;

/// The numbers of a report as one sealed document (io/json_file.hpp): name, title, digest, remarks, count of
/// verdicts, and the tables of tables.hpp as lists of objects; what a row lacks is null.
std::string to_json(const Report& report);

}  // namespace amble::report
