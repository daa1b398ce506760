#pragma once

#include <filesystem>

namespace amble::io {

/// Locks a folder for one process (flock on FOLDER/.lock; released by the system if the process dies). Throws
/// UserError(ExitCode::locked) naming the folder and the holder, another process by its id or this one, if it
/// is held.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int fd_ = -1;
};

/// Locks an existing file for one process without making or changing anything. The holder may replace the
/// file (io::write_file): whoever locks it afterwards gets the new one. Throws UserError(ExitCode::locked) if
/// another process holds it, ExitCode::io if there is no such file or it cannot be written to.
class FileLock {
 public:
  explicit FileLock(const std::filesystem::path& file);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int fd_ = -1;
};

}  // namespace amble::io
