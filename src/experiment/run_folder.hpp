#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "amble/experiment/champion.hpp"
#include "amble/experiment/config.hpp"
#include "amble/io/lock.hpp"

namespace amble::experiment {

/// Where the files of a run are (docs/FORMATS.md).
struct RunPaths {
  explicit RunPaths(const std::filesystem::path& folder);
  std::filesystem::path folder, config, robot, manifest, generations, checkpoint, champions;

  std::filesystem::path champion(int generation) const;
  /// Champion files in the order of their generations; the last is the best. Other files are ignored.
  std::vector<std::filesystem::path> champion_files() const;
  /// Throws UserError if the run has none.
  std::filesystem::path best_champion() const;
};

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

/// The paths of a run to read. Throws UserError: no folder, no run, or one of another version.
RunPaths find_run(const std::filesystem::path& folder);

/// The champion that a path names: a champion file is itself, a run folder its best champion. Throws
/// UserError as find_run(), or if the run has none.
std::filesystem::path champion_at(const std::filesystem::path& champion_or_run);

/// The same for a run wherever its folder is and however long it becomes, another for any other run, even
/// one of the same name in the same place. Throws UserError.
std::uint64_t run_identity(const RunPaths& paths);

/// Whether a folder looks like a run's.
bool is_run_folder(const std::filesystem::path& folder);

}  // namespace amble::experiment
