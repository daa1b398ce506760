#pragma once

#include "amble/damage/settings.hpp"
#include "amble/ground/settings.hpp"
#include "amble/io/json_file.hpp"
#include "amble/score/score.hpp"
#include "amble/trial/command_settings.hpp"

namespace amble::experiment {

/// Removes "score", "ground", "damage" and "command" where they are at their defaults, which files and hashes
/// of versions without them imply: so what was written then still matches.
void leave_out_implied(io::Json& json, const score::Settings& score, const ground::Settings& ground,
                       const damage::Settings& damage, const trial::CommandSettings& command);

}  // namespace amble::experiment
