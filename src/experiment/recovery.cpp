#include "amble/experiment/recovery.hpp"

#include <fmt/format.h>

#include <utility>

#include "amble/core/error.hpp"
#include "amble/experiment/champion.hpp"
#include "amble/io/file.hpp"

namespace amble::experiment {
namespace {

/// From one checkpoint and the logs beside it.
Recovery restore(const RunPaths& paths, const std::filesystem::path& checkpoint, const Config& config,
                 const Problem& problem) {
  Recovery recovery{.state = RunState(config, problem), .log_bytes = {}};
  search::Strategy& strategy = *recovery.state.strategy;
  recovery.state.progress = load_checkpoint(checkpoint, config, strategy);
  const auto logs = strategy.logs();
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const auto path = paths.folder / logs[i];
    if (!std::filesystem::exists(path))
      fail(ExitCode::bad_file, "{}: missing; the run cannot go on without it", path.string());
    io::InputFile file(path);
    recovery.log_bytes.push_back(strategy.restore_log(i, file, path.string()));
  }
  return recovery;
}

/// Throws UserError if the file of the best champion is missing, damaged or another one, which nothing else
/// would detect.
void check_best(const RunPaths& paths, const Config& config, const Progress& progress) {
  if (progress.best_generation < 0) return;
  const auto file = paths.champion(progress.best_generation);
  if (!std::filesystem::exists(file))
    fail(ExitCode::bad_file, "{}: missing, and it is the best of the run so far", file.string());
  const auto best = load_champion(file);
  if (best.generation != progress.best_generation || best.seed != config.seed ||
      best.objective() != progress.best)
    fail(ExitCode::bad_file, "{}: not the champion that the run had there: that reached {}, this one {}",
         file.string(), score::with_unit(fmt::format("{}", progress.best), config.score),
         score::with_unit(fmt::format("{}", best.objective()), config.score));
}

/// After a power cut a checkpoint may be on the disk, but not the files that it refers to.
bool has_its_table(const RunPaths& paths, const Recovery& recovery) {
  std::error_code error;
  const auto csv_bytes = std::filesystem::file_size(paths.generations, error);
  return !error && csv_bytes >= recovery.state.progress.csv_bytes;
}

}  // namespace

Recovery recover(const RunPaths& paths, const Config& config, const Problem& problem) {
  Recovery named = restore(paths, paths.checkpoint, config, problem);
  for (const auto& unnamed : unnamed_checkpoints(paths.checkpoint)) {
    try {
      Recovery newer = restore(paths, unnamed, config, problem);
      if (!has_its_table(paths, newer) || newer.state.strategy->round() <= named.state.strategy->round())
        continue;
      check_best(paths, config, newer.state.progress);
      io::write_file(paths.checkpoint, io::read_file(unnamed));
      return newer;
    } catch (const UserError&) {
      // Cut off while it was written, or one of its logs was: the checkpoint before it counts.
    }
  }
  check_best(paths, config, named.state.progress);
  return named;
}

}  // namespace amble::experiment
