#pragma once

#include <string_view>

#include "amble/damage/settings.hpp"

namespace amble::damage {

/// Damages in one line: KIND:NAME[=NUMBER][@SECONDS], separated by commas, with the number that the kind
/// needs:
///   missing:FL   numb:FL   slack:JOINT   locked:JOINT=ANGLE_RAD   weak:JOINT=SHARE
///   payload:BODY=MASS_KG/X_M/Y_M/Z_M
/// as in "missing:FL,weak:FR_knee=0.2@5". Throws UserError.
Settings parse(std::string_view text);

}  // namespace amble::damage
