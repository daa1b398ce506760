#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "amble/core/check.hpp"

namespace amble::fuzz {

/// A file in memory, for readers that need a path.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& bytes) : fd_(::memfd_create("input", 0)) {
    AMBLE_CHECK(fd_ >= 0, "a file in memory");
    const auto written = ::write(fd_, bytes.data(), bytes.size());
    AMBLE_CHECK(written == static_cast<ssize_t>(bytes.size()), "memory for the file");
  }
  ~MemoryFile() { ::close(fd_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(fd_); }

 private:
  int fd_;
};

}  // namespace amble::fuzz
