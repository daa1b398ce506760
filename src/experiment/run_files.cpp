#include "amble/experiment/run_files.hpp"

#include <algorithm>
#include <utility>

#include "amble/experiment/checkpoint.hpp"
#include "amble/experiment/run_table.hpp"

namespace amble::experiment {

namespace {

/// The first line of a run's table, which recover() has checked.
std::string header_of(const RunPaths& paths) {
  constexpr std::size_t most_bytes = 65536;
  std::string text = io::InputFile(paths.generations).read(most_bytes);
  text.resize(std::min(text.size(), text.find('\n')));
  return text;
}

}  // namespace

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

}  // namespace amble::experiment
