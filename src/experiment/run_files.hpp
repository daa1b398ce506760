#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <span>
#include <vector>

#include "amble/experiment/config.hpp"
#include "amble/experiment/generation_row.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/experiment/run_state.hpp"
#include "amble/io/file.hpp"

namespace amble::experiment {

/// The files of a run that are written after every generation: its table, the logs of its search, its
/// checkpoint. They are written in an order from which a run goes on wherever it is cut off.
class RunFiles {
 public:
  /// Those of a new run, with what belongs to them before the first generation. Throws UserError.
  static RunFiles start(const RunPaths& paths, const Config& config, RunState& state);
  /// Those of an earlier run; what goes beyond the state that was recovered is cut off. `log_bytes`: how much
  /// of each log belongs to it. Throws UserError.
  static RunFiles resume(const RunPaths& paths, const RunState& state,
                         std::span<const std::uint64_t> log_bytes);

  /// Adds a generation and brings `state.progress` up to date. What it writes cannot be lost with the process
  /// when it returns; it is synced while the next generation is evaluated. Throws UserError.
  void write(const GenerationRow& row, const Config& config, RunState& state);
  /// Waits until what write() wrote is on the disk. Throws UserError.
  void settle();

 private:
  RunFiles(const RunPaths& paths, const search::Strategy& strategy, std::uint64_t table_bytes,
           std::span<const std::uint64_t> log_bytes);

  std::filesystem::path checkpoint_;
  std::unique_ptr<io::AppendFile> table_;
  std::vector<std::unique_ptr<io::AppendFile>> logs_;
  std::future<void> settling_;
};

}  // namespace amble::experiment
