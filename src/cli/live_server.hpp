#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "amble/serving/server.hpp"
#include "amble/watch/watcher.hpp"

namespace amble::cli {

/// Where pages are served.
struct LiveOptions {
  std::optional<int> port;
  std::optional<std::string> address;
};

/// Adds --port and --address, which need the option `flag`.
void add_live(CLI::App& command, LiveOptions& options, CLI::Option* flag);

/// Serves the page of a run, or of all runs below a folder, while they go on (docs/WATCH.md).
class LiveServer {
 public:
  /// Takes the port. Throws UserError.
  explicit LiveServer(const LiveOptions& options);
  ~LiveServer();

  /// Begins to serve a folder, and says where. Throws UserError.
  void begin(const std::filesystem::path& folder);
  const watch::Watcher& watcher() const { return *watcher_; }
  /// Tells the pages how it ended, waits a moment until they have heard, and ends.
  void end(const std::string& text);

 private:
  class Pages;
  // In the order in which they may be destroyed, from the last.
  std::unique_ptr<watch::Watcher> watcher_;
  std::unique_ptr<Pages> pages_;
  serving::Server server_;
};

/// Whether and where a page of what a command computes is served meanwhile.
struct WatchOptions {
  bool watch = false;
  LiveOptions live;
  CLI::Option* flag = nullptr;  ///< --watch
};

/// Adds --watch, --port and --address. `what` goes on: "run", "study".
void add_watch(CLI::App& command, WatchOptions& options, const std::string& what);

/// Takes the port, which is done before anything is written; null without --watch. Throws UserError.
std::unique_ptr<LiveServer> server_for(const WatchOptions& options);

}  // namespace amble::cli
