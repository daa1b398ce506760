#include "amble/experiment/run_files.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/experiment/champion.hpp"
#include "amble/experiment/memory_need.hpp"
#include "amble/experiment/run_table.hpp"
#include "amble/io/file.hpp"
#include "amble/robot/json.hpp"
#include "amble/robot/original_model.hpp"
#include "amble/search/strategies.hpp"

namespace amble::experiment {
namespace {

/// The first line of a run's table, which recover() has checked.
std::string header_of(const RunPaths& paths) {
  constexpr std::size_t most_bytes = 65536;
  std::string text = io::InputFile(paths.generations).read(most_bytes);
  text.resize(std::min(text.size(), text.find('\n')));
  return text;
}

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
    fail(
        ExitCode::bad_file,
        "{}: missing, and it is the best of the run so far: put back a copy, the run cannot go on without it",
        file.string());
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

void check_search(const Config& config, const Problem& problem) {
  try {
    config.make_behaviour(&problem.robot);
    const double usable_bytes = usable_memory_bytes();
    if (const auto need = memory_of_generation(config, problem); need.bytes > usable_bytes)
      throw SettingError(
          need.keys,
          fmt::format(
              "not enough memory: a generation asks for {:.2g} GB by {}; this process may use {:.2g} GB",
              need.bytes / 1e9, need.what, usable_bytes / 1e9));
    search::strategy_kind(config.search).check_memory(config.search, space_of(config, problem), usable_bytes);
  } catch (const SettingError& error) {
    throw config.with_location(error);
  }
}

RunFiles::RunFiles(const RunPaths& paths, const search::Strategy& strategy, std::string header,
                   std::uint64_t table_bytes, std::span<const std::uint64_t> log_bytes)
    : checkpoint_(paths.checkpoint),
      header_(std::move(header)),
      table_(std::make_unique<io::AppendFile>(paths.generations, table_bytes)) {
  const auto names = strategy.logs();
  for (std::size_t i = 0; i < names.size(); ++i)
    logs_.push_back(std::make_unique<io::AppendFile>(paths.folder / names[i], log_bytes[i]));
}

RunFiles RunFiles::start(const RunPaths& paths, const Config& config, RunState& state) {
  RunFiles files(paths, *state.strategy, csv_header(state.strategy->metrics()), 0,
                 std::vector<std::uint64_t>(state.strategy->logs().size(), 0));
  files.table_->append(files.header_);
  state.progress.csv_bytes = files.table_->size();
  state.progress.csv_digest = table_digest(0, files.header_, files.header_);
  for (std::size_t i = 0; i < files.logs_.size(); ++i)
    files.logs_[i]->append(state.strategy->take_log_growth(i));
  save_checkpoint(files.checkpoint_, config, state.progress, *state.strategy);
  return files;
}

RunFiles RunFiles::resume(const RunPaths& paths, const RunState& state,
                          std::span<const std::uint64_t> log_bytes) {
  return RunFiles(paths, *state.strategy, header_of(paths), state.progress.csv_bytes, log_bytes);
}

void RunFiles::write(const GenerationRow& row, const Config& config, RunState& state) {
  settle();
  state.progress.evaluations += row.evaluations;
  state.progress.steps += row.steps;
  state.progress.wall_s += row.wall_s;
  const std::string line = csv_line(row, header_);
  table_->write(line);
  state.progress.csv_bytes = table_->size();
  state.progress.csv_digest = table_digest(state.progress.csv_digest, header_, line);
  for (std::size_t i = 0; i < logs_.size(); ++i)
    if (const auto growth = state.strategy->take_log_growth(i); !growth.empty()) logs_[i]->write(growth);
  auto checkpoint = std::make_unique<io::AtomicFile>(checkpoint_);
  checkpoint->write(checkpoint_bytes(config, state.progress, *state.strategy));
  // The files that the checkpoint refers to must be on the disk before it.
  std::vector<io::AppendFile*> before{table_.get()};
  for (const auto& log : logs_) before.push_back(log.get());
  settling_ = std::async(std::launch::async, [before = std::move(before), file = std::move(checkpoint)] {
    for (io::AppendFile* written : before) written->sync();
    file->commit();
  });
}

void RunFiles::settle() {
  if (settling_.valid()) settling_.get();
}

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
