#pragma once

#include <filesystem>
#include <string>

namespace amble::cli {

/// A name for a file in a new folder that is this user's alone, within the system's for such; both are gone
/// with the object, though not if the process is killed.
class ScratchFile {
 public:
  /// Throws UserError(ExitCode::io).
  explicit ScratchFile(const std::string& name);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace amble::cli
