#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace amble::io {

/// The whole file as bytes. Throws UserError(ExitCode::io) "PATH: reason".
std::string read_file(const std::filesystem::path& path);

/// Replaces `path` whole or not at all: writes PATH.tmp.<pid> in the same folder, syncs it, renames it, syncs the folder.
/// On any failure (no space, no permission) the temporary file is removed, an old file is left as it was, and
/// UserError(ExitCode::io) "cannot write PATH: reason" is thrown.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// A log that only grows (generations.csv): lines are appended whole and synced. On opening, what lies beyond `keep_bytes` is
/// cut off, so that a resumed run continues from its checkpoint. Throws UserError(ExitCode::io), also if the file is shorter.
class AppendFile {
 public:
  AppendFile(const std::filesystem::path& path, std::uint64_t keep_bytes);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  void append(std::string_view bytes);
  std::uint64_t size() const { return size_; }

 private:
  std::filesystem::path path_;
  int fd_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace amble::io
