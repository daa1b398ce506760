#include "amble/cli/live_server.hpp"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cstdint>
#include <thread>
#include <utility>

#include "amble/cli/messages.hpp"
#include "amble/cli/options.hpp"
#include "amble/core/clock.hpp"
#include "amble/page/html_page.hpp"
#include "amble/page/watch_page.hpp"
#include "amble/presentation/walker.hpp"

namespace amble::cli {
namespace {

using namespace std::chrono_literals;

constexpr double farewell_s = 2.0;

class Events : public serving::Stream {
 public:
  explicit Events(std::unique_ptr<watch::Watcher::Reader> reader) : reader_(std::move(reader)) {}
  std::optional<std::string> next(std::chrono::milliseconds longest) override {
    return reader_->next(longest);
  }

 private:
  std::unique_ptr<watch::Watcher::Reader> reader_;
};

std::optional<int> whole_number(const std::string& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

/// What is at which path.
class LiveServer::Pages : public serving::Site {
 public:
  explicit Pages(watch::Watcher& watcher)
      : watcher_(watcher),
        page_(std::make_shared<const std::string>(page::make_watch_page(presentation::made_by()))),
        module_(std::make_shared<const std::string>(page::browser_module())) {}

  serving::Answer get(const serving::Request& request) override {
    if (request.path == "/")
      return {.type = "text/html; charset=utf-8",
              .body = page_,
              .scripts = std::string(page::watch_page_scripts())};
    if (request.path == "/amble.wasm") return {.type = "application/wasm", .body = module_};
    if (request.path == "/runs") return file("application/json", watcher_.overview(), "");
    if (request.path == "/curves") return file("application/json", watcher_.curves(), "");
    const std::string run = request.value("run");
    if (request.path == "/champion")
      return file("application/json", champion(run, request), "no such champion\n");
    if (request.path == "/generations.csv")
      return file("text/csv; charset=utf-8", watcher_.table(run), "no such run\n");
    if (request.path == "/events")
      return {.type = "text/event-stream", .body = std::make_shared<std::string>()};
    return serving::text_answer(
        404, "there is /, /runs, /curves, /events?run=ID, /champion?run=ID and /generations.csv?run=ID\n");
  }

  std::unique_ptr<serving::Stream> events(const serving::Request& request) override {
    if (request.path != "/events") return nullptr;
    return std::make_unique<Events>(watcher_.read(request.value("run")));
  }

 private:
  /// The champion of a cell of the map, of a generation, or the latest; empty if there is none.
  std::string champion(const std::string& run, const serving::Request& request) const {
    const std::string generation = request.value("generation"), cell = request.value("cell");
    const auto number = whole_number(generation), place = whole_number(cell);
    if (!cell.empty())
      return place && *place >= 0 ? watcher_.elite(run, static_cast<std::uint32_t>(*place)) : std::string();
    return generation.empty() || number ? watcher_.champion(run, number) : std::string();
  }

  static serving::Answer file(const std::string& type, std::string text, const std::string& missing) {
    if (text.empty()) return serving::text_answer(404, missing);
    return {.type = type, .body = std::make_shared<const std::string>(std::move(text))};
  }

  watch::Watcher& watcher_;
  serving::Text page_, module_;
};

void add_live(CLI::App& command, LiveOptions& options, CLI::Option* flag) {
  command.add_option("--port", options.port, "Port of the page (default: a free one)")
      ->check(between(1, 65535))
      ->needs(flag);
  command
      .add_option("--address", options.address,
                  "Serve others too, at this address of the computer, by a token that is printed; without "
                  "encryption")
      ->type_name("ADDRESS")
      ->needs(flag);
}

void add_watch(CLI::App& command, WatchOptions& options, const std::string& what) {
  options.flag =
      command.add_flag("--watch", options.watch,
                       fmt::format("Serve a page of the {} while it goes on, to browsers here", what));
  add_live(command, options.live, options.flag);
}

std::unique_ptr<LiveServer> server_for(const WatchOptions& options) {
  return options.watch ? std::make_unique<LiveServer>(options.live) : nullptr;
}

LiveServer::LiveServer(const LiveOptions& options)
    : server_({.address = options.address, .port = options.port}) {}

LiveServer::~LiveServer() {
  if (watcher_) end("The program that served this page has ended.");
}

void LiveServer::begin(const std::filesystem::path& folder) {
  watcher_ = std::make_unique<watch::Watcher>(folder);
  pages_ = std::make_unique<Pages>(*watcher_);
  server_.serve(*pages_);
  print_message(fmt::format("watch it at {}\n", server_.url()));
}

void LiveServer::end(const std::string& text) {
  watcher_->end(text);
  const double until_s = now_s() + farewell_s;
  while (server_.connections() > 0 && now_s() < until_s) std::this_thread::sleep_for(10ms);
  server_.stop();
}

}  // namespace amble::cli
