#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace amble::experiment {

/// Where the files of a run are (docs/FORMATS.md).
struct RunPaths {
  /// Those of a run in this folder, whether there is one or not.
  explicit RunPaths(const std::filesystem::path& folder);

  std::filesystem::path folder;       ///< as it was given
  std::filesystem::path config;       ///< config.toml, with all settings of the run
  std::filesystem::path robot;        ///< robot.json, as it was read at the start
  std::filesystem::path manifest;     ///< manifest.json: version, and the processes that worked on it
  std::filesystem::path generations;  ///< generations.csv, a row for each generation
  std::filesystem::path checkpoint;   ///< checkpoint.bin, from which it continues
  std::filesystem::path champions;    ///< the folder of champion files

  /// The file of the champion of a generation, from 0.
  std::filesystem::path champion(int generation) const;
  /// Champion files in the order of their generations; the last is the best. Other files are ignored.
  std::vector<std::filesystem::path> champion_files() const;
  /// Throws UserError if the run has none, or if its table tells of a later one than there is.
  std::filesystem::path best_champion() const;
};

/// The paths of a run to read. Throws UserError: no folder, no run, or one of another version.
RunPaths find_run(const std::filesystem::path& folder);

/// The champion that a path names: of a run folder its best champion; any other path is returned as it is,
/// whether it exists or not. Throws UserError as find_run(), or if the run has none.
std::filesystem::path champion_at(const std::filesystem::path& champion_or_run);

/// The same for a run wherever its folder is and however long it becomes, another for any other run, even
/// one of the same name in the same place. Throws UserError.
std::uint64_t run_identity(const RunPaths& paths);

/// Of what a run has found so far: its table without times, and its champions' files. The same for the same
/// config, seed and version, for any number of workers, interrupted or not. Throws UserError.
std::uint64_t run_digest(const RunPaths& paths);

/// Whether a folder looks like a run's.
bool is_run_folder(const std::filesystem::path& folder);

/// Throws UserError for a file in the folder in which a run keeps its champions, be it there or not: a run
/// with another one in its place cannot go on.
void refuse_among_champions(const std::filesystem::path& file);

/// The generation of a champion's file, by its name; nothing for any other file.
std::optional<int> generation_of(const std::filesystem::path& file);

}  // namespace amble::experiment
