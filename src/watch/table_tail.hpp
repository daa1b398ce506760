#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace amble::watch {

/// A file as it was when it was looked at: another file, or the same one changed, has another.
struct FileMark {
  ino_t inode = 0;
  std::int64_t bytes = -1, changed_ns = 0;  ///< bytes −1: there is no file

  static FileMark of(const std::filesystem::path& path);
  bool exists() const { return bytes >= 0; }
  bool operator==(const FileMark&) const = default;
};

/// Bytes `from` … of a file, at most `most` of them; fewer, or none, where it ends or cannot be read.
std::string read_part(const std::filesystem::path& path, std::uint64_t from, std::uint64_t most);

/// The number in a table's cell; nothing if it is none, or not finite.
std::optional<double> number_in(std::string_view cell);

/// Follows a table to which another process appends lines, by whole lines.
class TableTail {
 public:
  explicit TableTail(std::filesystem::path path) : path_(std::move(path)) {}

  struct Growth {
    bool anew = false;  ///< it is another table now, or one that was cut back: `lines` is all of it
    std::vector<std::string> lines;  ///< without their ends; of a table that begins the first is the header
  };
  /// What has come since the last call. A table that is not there gives nothing.
  Growth poll();

 private:
  std::filesystem::path path_;
  FileMark mark_;
  std::uint64_t read_bytes_ = 0;  ///< whole lines that were given
  std::string last_line_;         ///< of these; with its end
};

}  // namespace amble::watch
