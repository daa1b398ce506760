#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace amble {

/// What the program `amble` returns to its caller; documented in docs/FORMATS.md.
enum class ExitCode : int {
  ok = 0,
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
  explicit UserError(const std::string& what, ExitCode code = ExitCode::bad_input)
      : std::runtime_error(what), code_(code) {}

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

  const std::vector<std::string>& keys() const { return keys_; }

 private:
  std::vector<std::string> keys_;
};

template <typename... Args>
[[noreturn]] void fail(ExitCode code, fmt::format_string<Args...> text, Args&&... args) {
  throw UserError(fmt::format(text, std::forward<Args>(args)...), code);
}

template <typename... Args>
[[noreturn]] void fail_setting(std::vector<std::string> keys, fmt::format_string<Args...> text,
                               Args&&... args) {
  throw SettingError(std::move(keys), fmt::format(text, std::forward<Args>(args)...));
}

}  // namespace amble
