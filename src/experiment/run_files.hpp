#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "amble/experiment/config.hpp"
#include "amble/experiment/plan/generation_row.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/experiment/run_state.hpp"
#include "amble/io/file.hpp"

namespace amble::experiment {

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

}  // namespace amble::experiment
