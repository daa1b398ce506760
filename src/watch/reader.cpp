// What a page is told, and in which order.
#include <algorithm>
#include <string_view>
#include <utility>

#include "amble/watch/watcher.hpp"

namespace amble::watch {
namespace {

/// Lines of a table at a time, so that a long one comes in pieces.
constexpr std::size_t most_lines = 500;

void add_event(std::string& events, std::string_view name, std::string_view data) {
  events.append("event: ").append(name).append("\ndata: ").append(data).append("\n\n");
}

std::string text_of(const io::Json& data) {
  return data.dump(-1, ' ', false, io::Json::error_handler_t::replace);
}

}  // namespace

Watcher::Reader::Reader(Watcher& watcher, std::string id)
    : watcher_(watcher), id_(std::move(id)), feed_(watcher.feed_of(id_)) {}

Watcher::Reader::~Reader() {
  const std::lock_guard lock(watcher_.mutex_);
  --watcher_.readers_;
}

std::optional<std::string> Watcher::Reader::next(std::chrono::milliseconds longest) {
  std::unique_lock lock(watcher_.mutex_);
  if (ended_) return std::nullopt;
  watcher_.changed_.wait_for(lock, longest, [this] { return is_behind() || watcher_.end_text_; });
  return events();
}

bool Watcher::Reader::is_behind() const {
  return seen_ != watcher_.version_ || (feed_ && lines_ < feed_->lines().size());
}

std::string Watcher::Reader::events() {
  std::string events;
  if (!feed_) feed_ = watcher_.feed_of(id_);
  if (seen_ < watcher_.folder_version_) add_event(events, "folder", text_of(watcher_.folder_json()));
  if (seen_ != watcher_.version_) add_runs(events);
  seen_ = watcher_.version_;
  if (feed_) add_rows(events);
  if (watcher_.end_text_ && !is_behind()) {
    add_event(events, "end", text_of({{"text", *watcher_.end_text_}}));
    ended_ = true;
  }
  return events;
}

void Watcher::Reader::add_runs(std::string& events) {
  io::Json changed = io::Json::array();
  for (const auto& [id, run] : watcher_.runs_)
    if (run->version > seen_) changed.push_back(run->reader.summary().json());
  if (!changed.empty()) add_event(events, "runs", text_of({{"runs", std::move(changed)}}));
}

void Watcher::Reader::add_rows(std::string& events) {
  const auto& lines = feed_->lines();
  if (beginning_ != feed_->beginning() && !lines.empty()) {
    beginning_ = feed_->beginning();
    lines_ = 1;
    add_event(events, "begin", text_of({{"header", lines.front()}}));
  }
  const std::size_t end = std::min(lines.size(), lines_ + most_lines);
  if (end > lines_) {
    io::Json some = io::Json::array();
    for (; lines_ < end; ++lines_) some.push_back(lines[lines_]);
    add_event(events, "rows", text_of({{"lines", std::move(some)}}));
  }
  if (populations_ == feed_->populations() || lines_ < lines.size()) return;
  populations_ = feed_->populations();
  add_event(events, "population", feed_->population());
}

}  // namespace amble::watch
