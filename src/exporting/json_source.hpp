#pragma once

#include <string>

#include "amble/experiment/champion.hpp"
#include "amble/exporting/controller_tables.hpp"
#include "amble/exporting/provenance.hpp"
#include "amble/exporting/trace.hpp"

namespace amble::exporting {

/// All that is known of a controller as one JSON document, "amble-export" (docs/EXPORT.md).
std::string json_source(const experiment::Champion& champion, const ControllerTables& tables,
                        const Provenance& provenance, const Trace& trace);

}  // namespace amble::exporting
