#pragma once

#include <string>

#include "amble/report/report.hpp"

namespace amble::report {

/// One self-contained HTML page, which is well-formed XML too: no network, no scripts.
std::string make_page(const Report& report);

}  // namespace amble::report
