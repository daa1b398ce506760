#include "amble/experiment/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "amble/cli/help.hpp"
#include "amble/cli/stop_signal.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/record/generations_csv.hpp"

namespace amble::cli {
namespace {

namespace fs = std::filesystem;

/// Champions that the run has kept, by its table, and that are no longer there.
std::vector<fs::path> missing_champions(const experiment::RunPaths& paths, const record::Generations& table) {
  std::vector<fs::path> missing;
  for (std::size_t i = 0; i < table.count(); ++i)
    if (record::keeps_champion(table, i))
      if (const auto file = paths.champion(static_cast<int>(i)); !fs::exists(file)) missing.push_back(file);
  return missing;
}

ExitCode verify(const fs::path& folder) {
  const auto paths = experiment::find_run(folder);
  auto origin = experiment::origin_of(paths);
  std::optional<UserError> no_table;
  try {
    origin.table = record::read_generations(paths.generations);
  } catch (const UserError& error) {  // champions can be run again without it
    no_table = error;
  }
  const auto files = paths.champion_files(), missing = missing_champions(paths, origin.table);
  if (files.empty() && missing.empty() && !no_table)
    fail(ExitCode::bad_input, "{}: no champion yet", folder.string());
  std::size_t agreeing = 0;
  for (const auto& file : files) {
    const auto verdict = experiment::verify_champion(file, stop_signal(), &origin);
    if (!verdict) fail(ExitCode::interrupted, "stopped before all champions were run");
    fmt::print("{} {}\n", file.string(), verdict->text);
    agreeing += verdict->agrees ? 1 : 0;
  }
  for (const auto& file : missing) fmt::print("{} missing\n", file.string());
  const std::size_t all = files.size() + missing.size();
  fmt::print("{} of {} champions agree\n", agreeing, all);
  if (no_table) throw *no_table;
  return agreeing == all ? ExitCode::ok : ExitCode::differs;
}

}  // namespace

void add_verify(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("verify", "Run every champion of a run again and compare step by step");
  auto folder = std::make_shared<fs::path>();
  command->add_option("DIR", *folder, "Run folder")->required();
  add_examples(*command, {{"amble verify runs/1", ""}});
  command->callback([folder, &action] { action = [folder] { return verify(*folder); }; });
}

}  // namespace amble::cli
