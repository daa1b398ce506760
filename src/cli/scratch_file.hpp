#pragma once

#include <filesystem>
#include <string>

namespace amble::cli {

/// A name for a file in the system's folder for such; the file is gone with the object, whatever happens.
class ScratchFile {
 public:
  /// "amble-KIND-PROCESS-NUMBER.rec".
  explicit ScratchFile(const std::string& kind);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace amble::cli
