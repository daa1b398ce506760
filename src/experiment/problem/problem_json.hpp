#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "amble/damage/settings.hpp"
#include "amble/experiment/problem/problem.hpp"
#include "amble/ground/settings.hpp"
#include "amble/io/json_file.hpp"
#include "amble/score/score.hpp"
#include "amble/trial/commands.hpp"

namespace amble::experiment {

/// The settings under which a champion is run again, as in its file, without the noise.
io::Json problem_json(const Problem& problem);

/// The problem of a champion file, its noise included, complete. Throws UserError for a missing or wrong key
/// and for parts that do not fit.
Problem problem_from_json(const io::JsonView& root);

/// Removes "score", "ground", "damage" and "command" where they are at their defaults, which files and hashes
/// of versions without them imply: so what was written then still matches.
void leave_out_implied(io::Json& json, const score::Settings& score, const ground::Settings& ground,
                       const damage::Settings& damage, const trial::CommandSettings& command);

/// trial::TraceObserver's hashes in files: eight hexadecimal digits per step.
std::string trace_text(const std::vector<std::uint32_t>& trace);
/// Throws UserError(ExitCode::bad_file).
std::vector<std::uint32_t> parse_trace(const io::JsonView& view);

}  // namespace amble::experiment
