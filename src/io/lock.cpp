#include "amble/io/lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <string>
#include <system_error>

#include "amble/core/error.hpp"

namespace amble::io {
namespace {

/// " (pid 123)", or nothing while the holder has not yet written its number.
std::string holder(int fd) {
  std::array<char, 32> text{};
  const ssize_t size = ::pread(fd, text.data(), text.size(), 0);
  long pid = 0;
  if (size > 0) std::from_chars(text.data(), text.data() + size, pid);
  return pid > 0 ? fmt::format(" (pid {})", pid) : std::string();
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder) {
  const auto path = folder / ".lock";
  fd_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (fd_ < 0)
    fail(ExitCode::io, "cannot lock {}: {}", folder.string(), std::generic_category().message(errno));

  if (::flock(fd_, LOCK_EX | LOCK_NB) != 0) {
    const int error = errno;
    const std::string who = holder(fd_);
    ::close(fd_);
    if (error == EWOULDBLOCK)
      fail(ExitCode::locked, "{} is in use by another process{}", folder.string(), who);
    fail(ExitCode::io, "cannot lock {}: {}", folder.string(), std::generic_category().message(error));
  }

  // The number only serves the message above; on a full disk the lock holds without it.
  const std::string pid = fmt::format("{}\n", ::getpid());
  if (::ftruncate(fd_, 0) == 0) static_cast<void>(::pwrite(fd_, pid.data(), pid.size(), 0) < 0);
}

FolderLock::~FolderLock() {
  ::close(fd_);
}

}  // namespace amble::io
