#pragma once

#include <filesystem>

namespace amble::io {

/// Locks a folder for one process (flock on FOLDER/.lock; released by the system if the process dies). Throws
/// UserError(ExitCode::locked) naming the folder and the holder's process id if another process holds it.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int fd_ = -1;
};

}  // namespace amble::io
