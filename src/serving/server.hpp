#pragma once

#include <memory>
#include <optional>
#include <string>

#include "amble/serving/site.hpp"

namespace amble::serving {

struct Settings {
  /// An address of this computer, to be reached by others, or a name of it. Nothing: 127.0.0.1, and no token.
  std::optional<std::string> address = {};
  std::optional<int> port = {};  ///< 1 … 65535; nothing: a free one
  int most_connections = 32;     ///< beyond these the answer is 503
};

/// Serves a site to browsers: read-only, by GET and HEAD, one request per connection, a thread for each, of
/// low priority. At the loopback address a request must name it in its Host header; with Settings::address it
/// must bring a random token instead.
class Server {
 public:
  /// Takes the port. Throws UserError: it is in use, not permitted, or there is no such address here.
  explicit Server(const Settings& settings);
  /// As stop().
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// What to open in a browser; with an address of one's own it ends in the token.
  std::string url() const;
  int port() const;
  /// Empty without.
  const std::string& token() const;

  /// Begins to answer. The site must live until stop(). Once only.
  void serve(Site& site);
  /// Connections that are open.
  int connections() const;
  /// Ends. Streams are cut off when they return from next().
  void stop();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace amble::serving
