#pragma once

#include <string>

#include "amble/damage/settings.hpp"

namespace amble::experiment {

/// `spec`: damages in one line (damage::parse), such as "missing:FL"; a config file with [damage]; or "none",
/// the intact robot. Throws UserError, also for a config without damage, which is easily named by mistake.
damage::Settings damage_of(const std::string& spec);

/// Throws SettingError for a damage that begins when a trial of `duration_s` has ended: it would be taken for
/// one that the robot bears.
void check_begins(const damage::Settings& damage, double duration_s);

}  // namespace amble::experiment
