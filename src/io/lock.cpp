#include "amble/io/lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <string>
#include <system_error>

#include "amble/core/error.hpp"

namespace amble::io {
namespace {

/// "this process", "another process (pid 123)", or without the number while the holder has not yet written
/// it.
std::string holder(int fd) {
  std::array<char, 32> text{};
  const ssize_t size = ::pread(fd, text.data(), text.size(), 0);
  long pid = 0;
  if (size > 0) std::from_chars(text.data(), text.data() + size, pid);
  if (pid == ::getpid()) return "this process";
  return pid > 0 ? fmt::format("another process (pid {})", pid) : "another process";
}

/// Locks an open file, which is closed where that fails. `what` is named in the message.
void lock_or_fail(int fd, const std::filesystem::path& what, bool has_holder) {
  if (::flock(fd, LOCK_EX | LOCK_NB) == 0) return;
  const int error = errno;
  const std::string who = has_holder ? holder(fd) : "another process";
  ::close(fd);
  if (error == EWOULDBLOCK) fail(ExitCode::locked, "{} is in use by {}", what.string(), who);
  fail(ExitCode::io, "cannot lock {}: {}", what.string(), std::generic_category().message(error));
}

int open_or_fail(const std::filesystem::path& path, int flags, const std::filesystem::path& what) {
  const int fd = ::open(path.c_str(), flags | O_RDWR | O_CLOEXEC, 0666);
  if (fd < 0) fail(ExitCode::io, "cannot lock {}: {}", what.string(), std::generic_category().message(errno));
  return fd;
}

bool is_still(int fd, const std::filesystem::path& path) {
  struct stat opened {};
  struct stat named {};
  return ::fstat(fd, &opened) == 0 && ::stat(path.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder)
    : fd_(open_or_fail(folder / ".lock", O_CREAT, folder)) {
  lock_or_fail(fd_, folder, true);

  // The number only serves the message above; on a full disk the lock holds without it.
  const std::string pid = fmt::format("{}\n", ::getpid());
  if (::ftruncate(fd_, 0) == 0) static_cast<void>(::pwrite(fd_, pid.data(), pid.size(), 0) < 0);
}

FolderLock::~FolderLock() {
  ::close(fd_);
}

FileLock::FileLock(const std::filesystem::path& file) {
  // A file that was replaced between opening and locking is no longer what the path names.
  while (true) {
    fd_ = open_or_fail(file, 0, file);
    lock_or_fail(fd_, file, false);
    if (is_still(fd_, file)) return;
    ::close(fd_);
  }
}

FileLock::~FileLock() {
  ::close(fd_);
}

}  // namespace amble::io
