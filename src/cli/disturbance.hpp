#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "amble/experiment/champion.hpp"
#include "amble/presentation/shown_trial.hpp"

namespace amble::cli {

/// Adds --level, --noise, --trials and --undisturbed. `trials`: how many there are by default, for the help.
void add_disturbance(CLI::App& command, presentation::TrialChoice& choice,
                     const std::string& trials = "64, or 16 in engines that run one at a time");

/// presentation::shown_trial() on all processors. Throws UserError(interrupted) on a stop signal.
presentation::ShownTrial shown_trial(const experiment::Champion& champion, std::optional<double> seconds,
                                     const std::optional<std::string>& engine,
                                     const presentation::TrialChoice& choice);

}  // namespace amble::cli
