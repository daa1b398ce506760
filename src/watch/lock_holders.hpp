#pragma once

#include <filesystem>
#include <set>
#include <utility>

namespace amble::watch {

/// Who holds the locks of run folders (io::FolderLock) on this computer, without touching them: to try a lock
/// would keep a run from beginning that tries it at the same moment. As Linux lists them in /proc/locks.
class LockHolders {
 public:
  /// As it is now.
  static LockHolders now();
  /// Whether the process that FOLDER/.lock names holds it. False also if that works on another computer.
  bool hold(const std::filesystem::path& folder) const;

 private:
  std::set<std::pair<long, unsigned long>> held_;  ///< process and inode
};

}  // namespace amble::watch
