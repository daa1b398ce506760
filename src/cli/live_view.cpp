#include "amble/cli/live_view.hpp"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <thread>

#include "amble/cli/messages.hpp"
#include "amble/cli/stop_signal.hpp"
#include "amble/io/quoting.hpp"
#include "amble/io/text.hpp"

namespace amble::cli {
namespace {

using watch::Stage;

std::string name_of(const std::filesystem::path& folder, const watch::Summary& run) {
  return io::printable((run.id == "." ? folder : folder / run.id).string());
}

/// What is said of a run in `folder` that came into a stage.
std::string stage_text(const watch::Summary& run, const std::filesystem::path& folder) {
  switch (run.stage) {
    case Stage::running:
      return fmt::format("goes on, generation {} of {}", run.done, run.generations);
    case Stage::stopped:
      return fmt::format("stopped at generation {} of {}; to continue, run: amble resume {}", run.done,
                         run.generations, io::shell_word((folder / run.id).lexically_normal().string()));
    case Stage::ended:
      return fmt::format("has ended, all {} generations are done", run.generations);
    case Stage::gone:
      return "its folder has vanished";
    case Stage::waiting:
      break;
  }
  return "has not begun";
}

}  // namespace

ExitCode make_live_view(const std::filesystem::path& folder, const LiveOptions& options) {
  const auto& stop = stop_signal();
  LiveServer server(options);
  server.begin(folder);
  if (server.watcher().summaries().empty())
    print_message(fmt::format(
        "{}: no run is here yet, or up to three folders below; the page waits for one. A study that has "
        "ended: amble report {}\n",
        io::printable(folder.string()), io::shell_word(folder.string())));
  std::map<std::string, Stage> told;
  bool gone = false;
  while (!stop) {
    for (const auto& run : server.watcher().summaries()) {
      const auto [known, is_new] = told.try_emplace(run.id, run.stage);
      if (is_new ? run.id != "." : known->second == run.stage) continue;
      known->second = run.stage;
      print_message(fmt::format("{}: {}\n", name_of(folder, run), stage_text(run, folder)));
    }
    if (server.watcher().is_gone() != gone) {
      gone = !gone;
      print_message(
          fmt::format("{}: {}\n", io::printable(folder.string()),
                      gone ? "has vanished; its pages show what was known, and wait" : "is there again"));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  server.end("The program that served this page was stopped.");
  return ExitCode::ok;
}

}  // namespace amble::cli
