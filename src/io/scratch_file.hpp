#pragma once

#include <filesystem>
#include <string>

namespace amble::io {

/// A path for a file in a new private folder within the system's folder for temporary files; both are removed
/// by the destructor.
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

}  // namespace amble::io
