#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// What all parts of amble share: errors, checks, random streams, vectors, rows of lanes. Each folder of
/// amble has a namespace of its own below this one. Units are SI, angles in radians; a number's name ends in
/// its unit. Frames and orders: docs/CONVENTIONS.md.
namespace amble {

/// What the program `amble` returns to its caller; documented in docs/FORMATS.md.
enum class ExitCode : int {
  ok = 0,           ///< done
  internal = 1,     ///< a defect of amble itself
  bad_input = 2,    ///< command line, config or robot file: the user can correct it
  bad_file = 3,     ///< a file amble wrote is truncated, altered or of another version
  io = 4,           ///< the system refused: missing file, no permission, disk full
  locked = 5,       ///< another process works in the run folder
  differs = 6,      ///< a champion does not repeat, or its file is unsound
  interrupted = 7,  ///< stopped by a signal; a run has its checkpoint, from which `amble resume` continues
};

/// A mistake the user can correct. Becomes one line on stderr ("amble: <what>") and the exit code; never a
/// stack trace. The text names file, line, key and value where known, and what was expected.
class UserError : public std::runtime_error {
 public:
  /// `what`: one line, without "amble: ". `code`: what the program exits with.
  explicit UserError(const std::string& what, ExitCode code = ExitCode::bad_input)
      : std::runtime_error(what), code_(code) {}

  /// What the program exits with because of it; bad_input unless it was made with another.
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// A UserError about a setting that is inconsistent with other settings or with the robot. Its text names the
/// key; the caller that has read the settings adds file and line (experiment::Config).
class SettingError : public UserError {
 public:
  /// `keys`: the paths of the settings that could be changed, e.g. "controller.substrate.nodes[2].sensor".
  SettingError(std::vector<std::string> keys, const std::string& what)
      : UserError(what), keys_(std::move(keys)) {}

  /// Paths of settings, as the constructor takes them.
  const std::vector<std::string>& keys() const { return keys_; }

 private:
  std::vector<std::string> keys_;
};

/// Throws UserError with this code. `text` is a format string of fmt, `args` its arguments; the result is one
/// line, without "amble: ".
template <typename... Args>
[[noreturn]] void fail(ExitCode code, fmt::format_string<Args...> text, Args&&... args) {
  throw UserError(fmt::format(text, std::forward<Args>(args)...), code);
}

/// Throws SettingError, whose code is ExitCode::bad_input. `keys`: paths of settings as SettingError takes
/// them; `text` and `args` as of fail(), and the line names the key.
template <typename... Args>
[[noreturn]] void fail_setting(std::vector<std::string> keys, fmt::format_string<Args...> text,
                               Args&&... args) {
  throw SettingError(std::move(keys), fmt::format(text, std::forward<Args>(args)...));
}

}  // namespace amble
