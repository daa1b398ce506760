#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace amble::serving {

/// What a page asks for: GET, of a path such as "/champion", with what follows its question mark.
struct Request {
  std::string path;
  std::map<std::string, std::string> query;

  /// The value of a key; empty if it is not there.
  std::string value(const std::string& key) const {
    const auto found = query.find(key);
    return found == query.end() ? std::string() : found->second;
  }
};

/// A text that is shared by those who send it.
using Text = std::shared_ptr<const std::string>;

struct Answer {
  int status = 200;  ///< of HTTP
  std::string type = "text/plain; charset=utf-8";
  Text body;
  std::string scripts =
      {};  ///< of a page: what may run in it, as a Content-Security-Policy lists it; else nothing may
};

inline Answer text_answer(int status, std::string text) {
  return {.status = status, .body = std::make_shared<const std::string>(std::move(text))};
}

/// Server-sent events to one page, as they come.
class Stream {
 public:
  virtual ~Stream() = default;
  /// What to send next, after at most `longest`: an empty text if there is nothing, nothing at the end.
  virtual std::optional<std::string> next(std::chrono::milliseconds longest) = 0;
};

/// What a server serves. Called by many threads at once. What it throws becomes an answer of status 500.
class Site {
 public:
  virtual ~Site() = default;
  virtual Answer get(const Request& request) = 0;
  /// The events of a path; null for a path without.
  virtual std::unique_ptr<Stream> events(const Request& request) = 0;
};

}  // namespace amble::serving
