#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>

#include "amble/core/error.hpp"

namespace amble::cli {

/// "unknown command 'evole' (did you mean 'evolve'?); amble help lists all".
std::string unknown_command(const CLI::App& app, std::string_view name);

/// What is wrong with a command line that CLI11 refused, and what to do: an input that does not exist before
/// an option that is missing; the option that may have been meant; the command whose help tells more.
UserError usage_error(const CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv);

}  // namespace amble::cli
