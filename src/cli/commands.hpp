#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "amble/core/error.hpp"

namespace amble::cli {

/// Set by the subcommand that was named; run after parsing.
using Action = std::function<ExitCode()>;

void add_evolve(CLI::App& app, Action& action);
void add_resume(CLI::App& app, Action& action);
void add_trial(CLI::App& app, Action& action);
void add_compare(CLI::App& app, Action& action);
void add_gait(CLI::App& app, Action& action);
void add_info(CLI::App& app, Action& action);
void add_robot(CLI::App& app, Action& action);
void add_verify(CLI::App& app, Action& action);
void add_page(CLI::App& app, Action& action);
void add_view(CLI::App& app, Action& action);
void add_lab(CLI::App& app, Action& action);
void add_draw(CLI::App& app, Action& action);
void add_export(CLI::App& app, Action& action);
void add_adapt(CLI::App& app, Action& action);
void add_repertoire(CLI::App& app, Action& action);
void add_settings(CLI::App& app, Action& action);
void add_substrate(CLI::App& app, Action& action);
void add_study(CLI::App& app, Action& action);
void add_report(CLI::App& app, Action& action);
/// After all others, which it describes.
void add_completion(CLI::App& app, Action& action);

}  // namespace amble::cli
