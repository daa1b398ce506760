#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "amble/experiment/champion.hpp"
#include "amble/experiment/config.hpp"
#include "amble/experiment/run_paths.hpp"
#include "amble/io/lock.hpp"

namespace amble::experiment {

/// One process that worked on a run, for the manifest.
struct ProcessNote {
  std::string started_utc;  ///< ISO 8601
  std::string version, commit, compiler, flags, cpu;
  int jobs = 0;
  int from_generation = 0;
};

/// A run folder locked by this process.
class RunFolder {
 public:
  /// Makes the folder and writes robot.json; it becomes a run with save_config(). Throws UserError: the
  /// folder holds a run or anything else, is locked, or cannot be written; then nothing in it was changed.
  static RunFolder create(const std::filesystem::path& folder, const robot::RobotSpec& robot);
  /// Locks the folder of an earlier run. Throws UserError as find_run(), or if it is locked.
  static RunFolder open(const std::filesystem::path& folder);

  const RunPaths& paths() const { return paths_; }
  Config load_config() const;
  void save_config(const Config& config) const;
  /// Writes the number of generations into config.toml, and leaves the rest as it is.
  void lengthen(const Config& config) const;
  robot::RobotSpec load_robot() const;
  void save_champion(const Champion& champion) const;
  /// Removes the temporary files of a process that was killed here.
  void remove_leftovers() const;
  /// Adds a line on this process to the manifest.
  void note_process(const Config& config, int jobs, int from_generation) const;

 private:
  explicit RunFolder(const std::filesystem::path& folder);

  RunPaths paths_;
  std::unique_ptr<io::FolderLock> lock_;
};

}  // namespace amble::experiment
