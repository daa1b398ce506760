#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace amble {

/// What the program `amble` returns to its caller; documented in docs/FORMATS.md.
enum class ExitCode : int {
  ok = 0,
  internal = 1,     ///< a defect of amble itself
  bad_input = 2,    ///< command line, config or robot file: the user can mend it
  bad_file = 3,     ///< a file amble wrote is truncated, altered or of another version
  io = 4,           ///< the system refused: missing file, no permission, disk full
  locked = 5,       ///< another process works in the run folder
  differs = 6,      ///< a champion does not repeat, or its file is unsound
  interrupted = 7,  ///< stopped by a signal; of a run the checkpoint stands, and `amble resume` goes on
};

/// A mistake the user can mend. Becomes one line on stderr ("amble: <what>") and the exit code; never a stack
/// trace. The text names file, line, key and value where there are such, and what was expected.
class UserError : public std::runtime_error {
 public:
  explicit UserError(const std::string& what, ExitCode code = ExitCode::bad_input)
      : std::runtime_error(what), code_(code) {}

  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

template <typename... Args>
[[noreturn]] void fail(ExitCode code, fmt::format_string<Args...> text, Args&&... args) {
  throw UserError(fmt::format(text, std::forward<Args>(args)...), code);
}

}  // namespace amble
