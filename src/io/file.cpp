#include "amble/io/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/hash.hpp"
#include "amble/core/index.hpp"

namespace amble::io {
namespace {

std::string reason(int error) {
  return std::generic_category().message(error);
}

[[noreturn]] void fail_to_write(const std::filesystem::path& path, int error) {
  fail(ExitCode::io, "cannot write {}: {}", path.string(), reason(error));
}

/// False, with errno set, if not all could be written.
bool write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) bytes.remove_prefix(to_index(written));
  }
  return true;
}

/// Devices and pipes cannot be synced, and need not be.
bool sync_descriptor(int fd) {
  return ::fsync(fd) == 0 || errno == EINVAL || errno == EROFS;
}

/// Syncs a new or renamed entry of the folder. False, with errno set, on failure.
bool sync_folder_of(const std::filesystem::path& path) {
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return errno == EACCES;  // a folder that may be written but not read cannot be synced
  const bool synced = sync_descriptor(fd);
  const int error = errno;
  ::close(fd);
  errno = error;
  return synced;
}

std::string& last_read() {
  thread_local std::string path;
  return path;
}

/// Where the standard output was, once outputs have it alone (keep_stdout_for()); else −1.
int kept_stdout = -1;

/// The open file of this process that a path leads to, as /dev/stdout does, whatever that file is.
std::optional<int> own_descriptor(std::filesystem::path path) {
  constexpr int most_links = 40;  // as the kernel's
  const std::string own = fmt::format("/proc/{}/fd", ::getpid());
  std::error_code error;
  for (int i = 0; i < most_links; ++i) {
    const auto folder = std::filesystem::canonical(std::filesystem::absolute(path).parent_path(), error);
    if (error) return std::nullopt;
    int number = -1;
    const std::string name = path.filename();
    const auto [end, fault] = std::from_chars(name.data(), name.data() + name.size(), number);
    if (folder == own && fault == std::errc() && end == name.data() + name.size()) return number;
    if (!std::filesystem::is_symlink(path, error)) return std::nullopt;
    const auto target = std::filesystem::read_symlink(path, error);
    if (error) return std::nullopt;
    path = target.is_absolute() ? target : folder / target;
  }
  return std::nullopt;
}

bool is_special_file(const std::filesystem::path& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

namespace fs = std::filesystem;

/// TMPDIR, or /tmp where it is not set; set to nothing is not set.
fs::path folder_for_temporary_files() {
  const char* const set = std::getenv("TMPDIR");
  if (set == nullptr || *set == '\0') return "/tmp";
  std::error_code error;
  if (!fs::is_directory(set, error))
    fail(ExitCode::io, "TMPDIR={}: {}: expected a folder for temporary files", set,
         error ? error.message() : "not a folder");
  return set;
}

fs::path new_folder() {
  const fs::path parent = folder_for_temporary_files();
  std::string name = (parent / "amble-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    fail(ExitCode::io, "cannot make folder {}: {}", name, std::generic_category().message(errno));
  return name;
}

}  // namespace

InputFile::InputFile(const std::filesystem::path& path)
    : path_(path), fd_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (fd_ < 0) fail(ExitCode::io, "{}: {}", path_.string(), reason(errno));
  last_read() = path_.string();
}

InputFile::InputFile(std::string bytes, const std::filesystem::path& path)
    : path_(path), bytes_(std::move(bytes)) {
  last_read() = path_.string();
}

std::string last_read_file() {
  return last_read();
}

InputFile::~InputFile() {
  if (fd_ >= 0) ::close(fd_);
}

std::string InputFile::read(std::uint64_t count) {
  if (fd_ < 0) {
    std::string part = bytes_.substr(
        position_, static_cast<std::size_t>(std::min<std::uint64_t>(count, bytes_.size() - position_)));
    position_ += part.size();
    return part;
  }
  constexpr std::uint64_t piece = std::uint64_t{1} << 20;
  std::string bytes;
  while (bytes.size() < count) {
    const std::size_t have = bytes.size();
    bytes.resize(have + static_cast<std::size_t>(std::min(piece, count - have)));
    const ssize_t got = ::read(fd_, bytes.data() + have, bytes.size() - have);
    const int error = errno;
    bytes.resize(have + to_index(std::max<ssize_t>(got, 0)));
    if (got < 0 && error != EINTR) fail(ExitCode::io, "{}: {}", path_.string(), reason(error));
    if (got == 0) break;
  }
  return bytes;
}

std::string read_file(const std::filesystem::path& path, std::uint64_t limit_bytes) {
  InputFile file(path);
  std::string bytes = file.read(limit_bytes + 1);
  if (bytes.size() > limit_bytes) fail(ExitCode::io, "{}: larger than {} bytes", path.string(), limit_bytes);
  return bytes;
}

std::filesystem::path temporary_of(const std::filesystem::path& path) {
  // Processes of other machines that share the folder may have this one's number.
  static const std::uint32_t machine = [] {
    std::array<char, 256> name{};
    ::gethostname(name.data(), name.size() - 1);
    return static_cast<std::uint32_t>(hash_text(name.data()));
  }();
  std::filesystem::path temporary = path;
  temporary += fmt::format("{}{}{:010}", temporary_mark, ::getpid(), machine);
  return temporary;
}

std::optional<std::filesystem::path> destination_of(const std::filesystem::path& temporary) {
  const std::string name = temporary.filename().string();
  const auto at = name.rfind(temporary_mark);
  if (at == std::string::npos) return std::nullopt;
  const auto process = std::string_view(name).substr(at + temporary_mark.size());
  if (process.empty() || process.find_first_not_of("0123456789") != std::string_view::npos)
    return std::nullopt;
  return temporary.parent_path() / name.substr(0, at);
}

AtomicFile::AtomicFile(const std::filesystem::path& path) : path_(path), written_path_(path) {
  if (const auto own = own_descriptor(path)) {
    std::fflush(stdout);  // what was printed before comes before
    fd_ = ::fcntl(*own == STDOUT_FILENO && kept_stdout >= 0 ? kept_stdout : *own, F_DUPFD_CLOEXEC, 0);
    if (fd_ < 0) fail_to_write(path_, errno);
    return;
  }
  if (!is_special_file(path)) written_path_ = temporary_of(path);
  fd_ = ::open(written_path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (fd_ < 0) fail_to_write(path_, errno);
}

AtomicFile::~AtomicFile() {
  if (fd_ < 0) return;
  ::close(fd_);
  if (written_path_ != path_) ::unlink(written_path_.c_str());
}

void AtomicFile::give_up() {
  const int error = errno;
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
  if (written_path_ != path_) ::unlink(written_path_.c_str());
  fail_to_write(path_, error);
}

void AtomicFile::write(std::string_view bytes) {
  AMBLE_CHECK(fd_ >= 0, "written to after commit() or a failure");
  if (!write_all(fd_, bytes)) give_up();
}

void AtomicFile::commit() {
  AMBLE_CHECK(fd_ >= 0, "committed twice or after a failure");
  if (!sync_descriptor(fd_)) give_up();
  const int fd = fd_;
  fd_ = -1;
  if (::close(fd) != 0) give_up();
  if (written_path_ == path_) return;
  if (::rename(written_path_.c_str(), path_.c_str()) != 0) give_up();
  if (!sync_folder_of(path_)) fail_to_write(path_, errno);
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

void sync_entry(const std::filesystem::path& path) {
  // "runs/a/" lies in "runs".
  if (!sync_folder_of(path.has_filename() ? path : path.parent_path())) fail_to_write(path, errno);
}

void make_folder(const std::filesystem::path& folder) {
  if (folder.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) fail(ExitCode::io, "cannot make folder {}: {}", folder.string(), error.message());
}

std::string why_no_folder(const std::filesystem::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) return "no such folder";
  if (error) return error.message();
  if (!fs::is_directory(status)) return "not a folder";
  const fs::directory_iterator contents(path, error);
  return error ? error.message() : "";
}

namespace {

/// Formats that others write as well, by how they begin, and what amble's own files have soon after.
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> own_marks{
    {{"<!DOCTYPE html>", "content=\"default-src 'none';"},
     {"<svg", " role=\"img\" aria-label=\""},
     {"#!/bin/bash", "$SLURM_ARRAY_TASK_ID/"}}};
constexpr std::size_t mark_within = 4096;

}  // namespace

void refuse_to_replace(const std::filesystem::path& path, std::string_view beginning, std::string_view what) {
  if (!std::filesystem::is_regular_file(path)) return;
  const std::string found = InputFile(path).read(mark_within);
  if (found.empty()) return;
  const auto* const mark =
      std::ranges::find(own_marks, beginning, &std::pair<std::string_view, std::string_view>::first);
  if (!found.starts_with(beginning) ||
      (mark != own_marks.end() && found.find(mark->second) == std::string::npos))
    fail(ExitCode::bad_input, "{} exists and is not {} that amble wrote: name another file", path.string(),
         what);
}

void check_output(const std::filesystem::path& path, std::string_view beginning, std::string_view what) {
  if (own_descriptor(path)) return;
  refuse_to_replace(path, beginning, what);
  if (is_special_file(path)) return;
  if (fs::is_directory(path) || !path.has_filename()) fail_to_write(path, EISDIR);
  // The folders between are made with the output.
  fs::path folder = fs::absolute(path).parent_path();
  while (!fs::exists(folder) && folder.has_relative_path()) folder = folder.parent_path();
  if (!fs::is_directory(folder)) fail_to_write(path, ENOTDIR);
  if (::access(folder.c_str(), W_OK | X_OK) != 0) fail_to_write(path, errno);
}

void keep_stdout_for(const std::filesystem::path& path) {
  if (kept_stdout >= 0 || own_descriptor(path) != STDOUT_FILENO) return;
  std::fflush(stdout);
  kept_stdout = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
  if (kept_stdout < 0 || ::dup2(STDERR_FILENO, STDOUT_FILENO) < 0) fail_to_write(path, errno);
}

void write_output(const std::filesystem::path& path, std::string_view bytes) {
  make_folder(path.parent_path());
  write_file(path, bytes);
}

AppendFile::AppendFile(const std::filesystem::path& path, std::uint64_t keep_bytes)
    : path_(path),
      fd_(::open(path.c_str(), O_WRONLY | (keep_bytes == 0 ? O_CREAT : 0) | O_CLOEXEC, 0666)),
      size_(keep_bytes) {
  if (fd_ < 0 && errno == ENOENT && keep_bytes > 0)
    fail(ExitCode::bad_file, "{}: missing: {} bytes were expected", path_.string(), keep_bytes);
  if (fd_ < 0) fail_to_write(path_, errno);
  try {
    cut_back_to(keep_bytes);
  } catch (...) {
    ::close(fd_);  // the destructor does not run when a constructor throws
    throw;
  }
}

void AppendFile::cut_back_to(std::uint64_t keep_bytes) {
  const off_t length = ::lseek(fd_, 0, SEEK_END);
  if (length < 0) fail_to_write(path_, errno);
  if (static_cast<std::uint64_t>(length) < keep_bytes)
    fail(ExitCode::bad_file, "{}: truncated: it has {} bytes, {} were expected", path_.string(), length,
         keep_bytes);
  const auto kept = static_cast<off_t>(keep_bytes);
  if (::ftruncate(fd_, kept) != 0 || ::lseek(fd_, kept, SEEK_SET) != kept || !sync_descriptor(fd_) ||
      !sync_folder_of(path_))
    fail_to_write(path_, errno);
}

AppendFile::~AppendFile() {
  ::close(fd_);
}

void AppendFile::append(std::string_view bytes) {
  write(bytes);
  sync();
}

void AppendFile::write(std::string_view bytes) {
  if (!write_all(fd_, bytes)) {
    const int error = errno;
    // Remove a partial line: the next append continues after the last whole one.
    const auto whole = static_cast<off_t>(size_);
    if (::ftruncate(fd_, whole) == 0) ::lseek(fd_, whole, SEEK_SET);
    fail_to_write(path_, error);
  }
  size_ += bytes.size();
}

void AppendFile::sync() {
  if (!sync_descriptor(fd_)) fail_to_write(path_, errno);
}

ScratchFile::ScratchFile(const std::string& name) : path_(new_folder() / name) {}

ScratchFile::~ScratchFile() {
  std::error_code none;
  fs::remove_all(path_.parent_path(), none);
}

}  // namespace amble::io
