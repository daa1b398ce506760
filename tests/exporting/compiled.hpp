#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "amble/exporting/c_source.hpp"

namespace amble::tests {

/// What every exported source must bear.
inline const std::string strict_flags = "-std=c99 -pedantic -Wall -Wextra -Wconversion -Wshadow -Werror";

struct Ran {
  int exit_code = -1;
  std::string out;  ///< standard output and error
};

/// Runs a command of the shell.
Ran run_shell(const std::string& command);

/// A champion's controller as C source "walker.c" in a folder.
exporting::CSource write_walker(const std::filesystem::path& folder, const experiment::Champion& champion,
                                exporting::Arithmetic arithmetic = exporting::Arithmetic::float32);

/// Compiles walker.c with a main source beside it, by `compiler` and `flags`. Returns the compiler's output;
/// no output: it had nothing to say.
std::string compile(const std::filesystem::path& folder, const std::string& compiler,
                    const std::string& flags, const std::filesystem::path& main, const std::string& program);

/// What differs between a trace and the answers of a compiled walker to its sensors.
struct Difference {
  std::size_t ticks = 0;     ///< compared
  double largest_rad = 0.0;  ///< of targets
  std::size_t targets_of_other_bits = 0, states_of_other_bits = 0;
  std::string printed = {};  ///< by the program, to its standard error
};
Difference replay(const std::filesystem::path& program, const exporting::ControllerTables& tables,
                  const exporting::Trace& trace);

}  // namespace amble::tests
