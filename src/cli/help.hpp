#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>

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

/// What help looks like: at most 100 columns, values by what they are (PATH, N, NUMBER, a|b), which options
/// exclude each other left to the message that says so.
std::shared_ptr<CLI::FormatterBase> help_formatter();

/// A command line, and what it is for.
struct Example {
  std::string_view line, what;
};
/// Puts examples at the end of a command's help.
void add_examples(CLI::App& command, std::initializer_list<Example> examples);

/// The command `help [COMMAND]`, after all others.
void add_help(CLI::App& app, Action& action);

/// "unknown command 'evole' (did you mean 'evolve'?); amble help lists all".
std::string unknown_command(const CLI::App& app, std::string_view name);

/// Throws UserError for an option or a place of the command that was given "": most often a variable of a
/// shell that is not set.
void refuse_empty_values(const CLI::App& app);

/// What is wrong with a command line that CLI11 refused, and what to do: an input that does not exist before
/// an option that is missing; the option that may have been meant; the command whose help tells more.
UserError usage_error(const CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv);

}  // namespace amble::cli
