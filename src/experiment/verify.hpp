#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>

namespace amble::experiment {

/// What came of running a champion again.
struct Verdict {
  bool agrees = false;
  std::string text;  ///< "agrees: …", "differs: …" with the first step that does, or "unsound: …"
};

/// Runs the champion of a file again, step by step against its trace. An altered or unsound file is a
/// verdict, not an error. Nothing if `stop` was set. Throws UserError if the file cannot be read at all.
std::optional<Verdict> verify_champion(const std::filesystem::path& path, const std::atomic<bool>& stop);

}  // namespace amble::experiment
