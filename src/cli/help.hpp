#pragma once

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>

#include "amble/cli/commands.hpp"

namespace amble::cli {

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

}  // namespace amble::cli
