#pragma once

#include <optional>
#include <string>
#include <vector>

#include "amble/experiment/plan/config.hpp"
#include "amble/experiment/problem/problem.hpp"

namespace amble::experiment {

/// The assignments ("KEY=VALUE") that set what this config does not use: of another controller or search than
/// its own, or switched off by another setting. In the words "controller.ctrnn.rate has no effect:
/// controller.kind is \"supg\"".
std::vector<std::string> idle_assignments(const Config& config, const std::vector<std::string>& assignments);

/// What a problem was given, wherever that was set, and its controllers do not use: sensors that are read in
/// some way and that they do not read, sensors of modulated SUPGs that may change nothing, commands.
std::vector<std::string> idle_parts(const Problem& problem);

/// That commands change nothing, in the words "this champion senses no commands, and walks as it would
/// without"; nothing if its controller senses them.
std::optional<std::string> unheard_commands(const Problem& problem);

/// Listed commands that begin when the problem's trial has ended, which are easily taken for followed, in the
/// words "what begins after 15 s is never told, as the trial is 10 s long"; nothing if all are told.
std::optional<std::string> untold_commands(const Problem& problem);

}  // namespace amble::experiment
