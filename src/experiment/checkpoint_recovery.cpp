#include "amble/experiment/checkpoint_recovery.hpp"

#include <fmt/format.h>

#include <utility>

#include "amble/core/error.hpp"
#include "amble/experiment/champion.hpp"
#include "amble/experiment/checkpoint.hpp"
#include "amble/experiment/run_table.hpp"
#include "amble/io/file.hpp"
#include "amble/robot/json.hpp"
#include "amble/robot/original_model.hpp"

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
void check_best(const RunPaths& paths, const Config& config, const Problem& problem,
                const Progress& progress) {
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
  if (robot::to_json(best.problem.robot) != robot::to_json(problem.robot) ||
      !robot::same_original_model(best.problem.robot, problem.robot))
    fail(ExitCode::bad_file,
         "{}: not the robot that the run had: {} walked with another one. Put back a copy of the file; "
         "nothing "
         "has been done now",
         paths.robot.string(), file.string());
}

/// Throws UserError if the files beside a checkpoint are not those that it was written with.
void check_beside(const RunPaths& paths, const Config& config, const Problem& problem, Recovery& recovery) {
  Progress& progress = recovery.state.progress;
  check_best(paths, config, problem, progress);
  progress.csv_digest = check_table(paths, progress, *recovery.state.strategy);
}

}  // namespace

Recovery recover(const RunPaths& paths, const Config& config, const Problem& problem) {
  Recovery named = restore(paths, paths.checkpoint, config, problem);
  for (const auto& unnamed : unnamed_checkpoints(paths.checkpoint)) {
    try {
      Recovery newer = restore(paths, unnamed, config, problem);
      if (newer.state.strategy->round() <= named.state.strategy->round()) continue;
      check_beside(paths, config, problem, newer);
      io::write_file(paths.checkpoint, io::read_file(unnamed));
      return newer;
    } catch (const UserError&) {
      // Cut off while it was written, or one of the files that it refers to was: the checkpoint before
      // counts.
    }
  }
  check_beside(paths, config, problem, named);
  return named;
}

}  // namespace amble::experiment
