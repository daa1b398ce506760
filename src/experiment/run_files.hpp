#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "amble/experiment/checkpoint.hpp"
#include "amble/experiment/config.hpp"
#include "amble/experiment/plan/checkpoint.hpp"
#include "amble/experiment/plan/generation_row.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/io/file.hpp"
#include "amble/search/strategy.hpp"

namespace amble::experiment {

/// Throws UserError if the config's search does not fit the robot, or could need more memory than this
/// process may use, which could otherwise kill it after hours.
void check_search(const Config& config, const Problem& problem);

/// The files of a run that are written after every generation: its table, the logs of its search, its
/// checkpoint. They are written in an order that allows a run to continue wherever it is interrupted.
class RunFiles {
 public:
  /// The files of a new run, with their content before the first generation. Throws UserError.
  static RunFiles start(const RunPaths& paths, const Config& config, RunState& state);
  /// The files of an earlier run, truncated to the recovered state. `log_bytes`: length of each log in that
  /// state. Throws UserError.
  static RunFiles resume(const RunPaths& paths, const RunState& state,
                         std::span<const std::uint64_t> log_bytes);

  /// Adds a generation and updates `state.progress`. When it returns, what it wrote survives the process; it
  /// is synced while the next generation is evaluated. Throws UserError.
  void write(const GenerationRow& row, const Config& config, RunState& state);
  /// Waits until what write() wrote is on the disk. Throws UserError.
  void settle();

 private:
  RunFiles(const RunPaths& paths, const search::Strategy& strategy, std::string header,
           std::uint64_t table_bytes, std::span<const std::uint64_t> log_bytes);

  std::filesystem::path checkpoint_;
  std::string header_;  ///< of the table; that of the build which began it
  std::unique_ptr<io::AppendFile> table_;
  std::vector<std::unique_ptr<io::AppendFile>> logs_;
  std::future<void> settling_;
};

/// The state from which an interrupted run continues.
struct Recovery {
  RunState state;
  std::vector<std::uint64_t> log_bytes;  ///< length of each of the search's logs at that state
};

/// Reads it from the newest checkpoint of a run folder that is complete, as are the files that it refers to.
/// A process may have been killed after writing a checkpoint and before renaming it; it is then renamed.
/// Throws UserError: no valid checkpoint or log, or the best champion's file is missing or another one.
Recovery recover(const RunPaths& paths, const Config& config, const Problem& problem);

}  // namespace amble::experiment
