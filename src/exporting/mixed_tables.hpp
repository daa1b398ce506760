#pragma once

#include "amble/controllers/mixed.hpp"
#include "amble/exporting/controller_tables.hpp"

namespace amble::exporting {

/// What is around the SUPGs of a mixed controller.
SupgTables::Mixed mixed_tables(const controllers::MixedArchitecture& architecture,
                               const controllers::MixedParameters& parameters, const robot::RobotSpec& robot);

}  // namespace amble::exporting
