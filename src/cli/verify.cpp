#include "amble/experiment/verify.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "amble/cli/commands.hpp"
#include "amble/cli/stop_signal.hpp"
#include "amble/experiment/run_folder.hpp"

namespace amble::cli {
namespace {

ExitCode verify(const std::filesystem::path& folder) {
  const auto files = experiment::find_run(folder).champion_files();
  if (files.empty()) fail(ExitCode::bad_input, "{}: no champion yet", folder.string());
  int differing = 0;
  for (const auto& file : files) {
    const auto verdict = experiment::verify_champion(file, stop_signal());
    if (!verdict) fail(ExitCode::interrupted, "stopped before all champions were run");
    fmt::print("{} {}\n", file.string(), verdict->text);
    differing += !verdict->agrees;
  }
  fmt::print("{} of {} champions agree\n", files.size() - static_cast<std::size_t>(differing), files.size());
  return differing == 0 ? ExitCode::ok : ExitCode::differs;
}

}  // namespace

void add_verify(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("verify", "Run every champion of a run again and compare step by step");
  auto folder = std::make_shared<std::filesystem::path>();
  command->add_option("DIR", *folder, "Run folder")->required();
  command->callback([folder, &action] { action = [folder] { return verify(*folder); }; });
}

}  // namespace amble::cli
