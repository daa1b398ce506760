#include "amble/watch/table_tail.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <system_error>

namespace amble::watch {
namespace {

constexpr std::uint64_t most_bytes = std::uint64_t{1} << 28;

}  // namespace

FileMark FileMark::of(const std::filesystem::path& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0 || !S_ISREG(found.st_mode)) return {};
  return {found.st_ino, found.st_size, found.st_mtim.tv_sec * 1'000'000'000 + found.st_mtim.tv_nsec};
}

std::string read_part(const std::filesystem::path& path, std::uint64_t from, std::uint64_t most) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return {};
  struct stat found {};
  std::string bytes;
  if (::fstat(fd, &found) == 0 && static_cast<std::uint64_t>(found.st_size) > from)
    bytes.resize(std::min(most, static_cast<std::uint64_t>(found.st_size) - from));
  std::size_t count = 0;
  while (count < bytes.size()) {
    const ssize_t more =
        ::pread(fd, bytes.data() + count, bytes.size() - count, static_cast<off_t>(from + count));
    if (more <= 0) break;
    count += static_cast<std::size_t>(more);
  }
  ::close(fd);
  bytes.resize(count);
  return bytes;
}

std::optional<double> number_in(std::string_view cell) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

TableTail::Growth TableTail::poll() {
  const FileMark mark = FileMark::of(path_);
  if (!mark.exists() || mark == mark_) return {};
  const bool other = mark.inode != mark_.inode;
  mark_ = mark;
  // The last line is read again: a table that was cut back and has grown since has another one there.
  std::uint64_t from = read_bytes_ - last_line_.size();
  std::string bytes = read_part(path_, from, most_bytes);
  Growth growth{.anew = read_bytes_ == 0 || other || !bytes.starts_with(last_line_), .lines = {}};
  if (growth.anew) {
    bytes = read_part(path_, from = 0, most_bytes);
    last_line_.clear();
  }
  std::size_t at = last_line_.size();
  for (std::size_t end = bytes.find('\n', at); end != std::string::npos; end = bytes.find('\n', at)) {
    last_line_ = bytes.substr(at, end + 1 - at);
    growth.lines.push_back(bytes.substr(at, end - at));
    at = end + 1;
  }
  read_bytes_ = from + at;
  if (bytes.size() == most_bytes) mark_ = {};  // the rest with the next call
  if (growth.lines.empty() && read_bytes_ == 0) growth.anew = false;
  return growth;
}

}  // namespace amble::watch
