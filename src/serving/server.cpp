#include "amble/serving/server.hpp"

#include <fmt/format.h>
#include <httplib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/io/background_thread.hpp"
#include "amble/serving/access.hpp"
#include "amble/serving/bind_error.hpp"

namespace amble::serving {
namespace {

using namespace std::chrono_literals;

constexpr const char* loopback = "127.0.0.1";
/// How long a connection may say nothing, and how long its receiver may take nothing.
constexpr time_t silence_s = 2, stuck_s = 2;
/// How often a stream looks whether its page is still there, and how often it says so itself.
constexpr std::chrono::milliseconds look_every = 1s, speak_every = 10s;
constexpr std::string_view still_here = ": still here\n\n";

constexpr const char* policy_header = "Content-Security-Policy";

/// What a browser may do with what it gets, and which scripts of it may run.
std::string policy(std::string_view scripts) {
  return fmt::format(
      "default-src 'none'; script-src {}; style-src 'unsafe-inline'; img-src data: blob:; connect-src "
      "'self'; "
      "worker-src blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
      scripts);
}

/// What browsers may do with what they get. A page brings its own policy too, which is as strict.
const httplib::Headers& headers_of_all() {
  static const httplib::Headers headers{{"Cache-Control", "no-store"},
                                        {policy_header, policy("'none'")},
                                        {"Cross-Origin-Resource-Policy", "same-origin"},
                                        {"Referrer-Policy", "no-referrer"},
                                        {"X-Content-Type-Options", "nosniff"},
                                        {"X-Frame-Options", "DENY"}};
  return headers;
}

/// Set in a thread while it answers a connection for which there is no room.
thread_local bool refusing = false;

/// A thread for each connection up to a number. Beyond it the thread that accepts connections answers itself,
/// "too many", and accepts no other meanwhile. (The library's own pool would let the page behind its last
/// thread wait for ever, as streams do not end.)
class Connections : public httplib::TaskQueue {
 public:
  Connections(int most, std::atomic<int>& open) : most_(most), open_(open) {}

  void enqueue(std::function<void()> answer) override {
    if (hand_over(answer)) return condition_.notify_one();
    refusing = true;
    answer();
    refusing = false;
  }

  void shutdown() override {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    condition_.notify_all();
    for (auto& thread : threads_) thread.join();
  }

 private:
  /// False if there is no room.
  bool hand_over(std::function<void()>& answer) {
    const std::lock_guard lock(mutex_);
    if (open_ >= most_) return false;
    ++open_;
    waiting_.push_back(std::move(answer));
    if (waiting_.size() > idle_) {
      threads_.emplace_back([this] { work(); });
      ++idle_;
    }
    return true;
  }

  void work() {
    io::be_background_thread();
    std::unique_lock lock(mutex_);
    while (true) {
      condition_.wait(lock, [this] { return !waiting_.empty() || ended_; });
      --idle_;
      if (waiting_.empty()) return;
      const auto answer = std::move(waiting_.front());
      waiting_.pop_front();
      lock.unlock();
      answer();
      lock.lock();
      --open_;
      ++idle_;
    }
  }

  const int most_;
  std::atomic<int>& open_;
  std::mutex mutex_;
  std::condition_variable condition_;
  std::deque<std::function<void()>> waiting_;
  std::vector<std::thread> threads_;
  std::size_t idle_ = 0;  ///< threads that wait, or have just been made
  bool ended_ = false;
};

/// The name of an address in a URL: that of this computer where it means all of its addresses.
std::string name_in_url(const std::string& address) {
  if (address == "0.0.0.0" || address == "::") {
    std::array<char, 256> name{};
    if (::gethostname(name.data(), name.size() - 1) == 0 && name[0] != '\0') return name.data();
  }
  return address.find(':') == std::string::npos ? address : fmt::format("[{}]", address);
}

void refuse(httplib::Response& response, int status, const std::string& text) {
  response.status = status;
  response.set_content(text + "\n", "text/plain; charset=utf-8");
}

/// By a provider: what has none the library compresses, which takes seconds for a page.
void send(httplib::Response& response, const Answer& answer) {
  response.status = answer.status;
  if (!answer.scripts.empty()) {
    response.headers.erase(policy_header);  // a second one would not replace it: browsers obey both
    response.set_header(policy_header, policy(answer.scripts));
  }
  if (answer.body->empty()) return response.set_content("", answer.type);
  response.set_content_provider(
      answer.body->size(), answer.type,
      [body = answer.body](std::size_t at, std::size_t length, httplib::DataSink& sink) {
        return sink.write(body->data() + at, length);
      });
}

/// Sends what a stream has; false once its page is gone.
bool send_next(Stream& stream, std::chrono::steady_clock::time_point& spoke, httplib::DataSink& sink) {
  std::optional<std::string> text;
  try {
    text = stream.next(look_every);
  } catch (const std::exception&) {
    return false;  // the page connects anew
  }
  if (!text) {
    sink.done();
    return true;
  }
  const auto now = std::chrono::steady_clock::now();
  if (text->empty() && now - spoke < speak_every) return sink.is_writable();
  if (text->empty()) *text = still_here;
  spoke = now;
  return sink.write(text->data(), text->size());
}

void send(httplib::Response& response, std::shared_ptr<Stream> stream) {
  response.status = 200;
  response.set_content_provider(
      "text/event-stream",
      [stream = std::move(stream), spoke = std::chrono::steady_clock::now()](
          std::size_t, httplib::DataSink& sink) mutable { return send_next(*stream, spoke, sink); });
}

}  // namespace

class Server::Implementation {
 public:
  explicit Implementation(const Settings& settings) : settings_(settings) {
    const std::string address = settings.address.value_or(loopback);
    if (settings.address) token_ = random_token();
    // The library's own options let two servers share a port, each getting some of the connections.
    server_.set_socket_options([](socket_t socket) {
      const int yes = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    });
    server_.set_tcp_nodelay(true);
    server_.set_keep_alive_max_count(1);
    server_.set_keep_alive_timeout(silence_s);
    server_.set_read_timeout(silence_s);
    server_.set_write_timeout(stuck_s);
    server_.set_payload_max_length(0);
    server_.set_default_headers(headers_of_all());
    server_.new_task_queue = [this] { return new Connections(settings_.most_connections, open_); };
    server_.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      answer(request, response);
      return httplib::Server::HandlerResponse::Handled;
    });
    port_ = settings.port ? (server_.bind_to_port(address, *settings.port) ? *settings.port : -1)
                          : server_.bind_to_any_port(address);
    if (port_ < 0)
      fail_to_bind(address, settings.address.has_value(), settings.port.value_or(0),
                   settings.port.has_value());
  }

  ~Implementation() { stop(); }

  std::string url() const {
    return fmt::format("http://{}:{}/{}", name_in_url(settings_.address.value_or(loopback)), port_,
                       token_.empty() ? "" : "?token=" + token_);
  }
  int port() const { return port_; }
  const std::string& token() const { return token_; }
  int connections() const { return open_; }

  void serve(Site& site) {
    site_ = &site;
    thread_ = std::thread([this] {
      io::be_background_thread();
      server_.listen_after_bind();
      ended_ = true;
    });
    // stop() of a server that has not begun would be forgotten.
    while (!server_.is_running() && !ended_) std::this_thread::sleep_for(1ms);
  }

  void stop() {
    if (!thread_.joinable()) return;
    server_.stop();
    thread_.join();
  }

 private:
  void answer(const httplib::Request& request, httplib::Response& response) {
    try {
      if (is_allowed(request, response)) answer_allowed(request, response);
    } catch (const std::exception& error) {
      refuse(response, 500, error.what());
    }
  }

  /// Whether a request may be answered; else the response says why not.
  bool is_allowed(const httplib::Request& request, httplib::Response& response) const {
    if (refusing) {
      response.set_header("Retry-After", "5");
      refuse(response, 503,
             fmt::format("{} connections are open already: close a page, then load this one again",
                         settings_.most_connections));
      return false;
    }
    if (request.method != "GET" && request.method != "HEAD") {
      response.set_header("Allow", "GET, HEAD");
      refuse(response, 405, "this server is read-only: GET and HEAD");
      return false;
    }
    if (token_.empty() &&
        (request.get_header_value_count("Host") != 1 || !names_loopback(request.get_header_value("Host")))) {
      refuse(response, 403, fmt::format("not under this name: open {}", url()));
      return false;
    }
    const std::string from = request.get_header_value("Sec-Fetch-Site");
    if ((from == "cross-site" || from == "same-site") &&
        request.get_header_value("Sec-Fetch-Mode") != "navigate") {
      refuse(response, 403, "not for pages from elsewhere");
      return false;
    }
    if (!token_.empty() && !has_token(request)) {
      refuse(response, 401, "open the address that the program has printed: it ends in a token");
      return false;
    }
    return true;
  }

  bool has_token(const httplib::Request& request) const {
    const std::string cookies = request.get_header_value("Cookie");
    const bool by_cookie = same_token(token_, cookie(cookies, cookie_name()));
    const bool by_query = same_token(token_, request.get_param_value("token"));
    return by_cookie || by_query;
  }

  /// Cookies are of a host, not of a port.
  std::string cookie_name() const { return fmt::format("amble-{}", port_); }

  void answer_allowed(const httplib::Request& request, httplib::Response& response) {
    // The token goes from the address, which histories keep and people copy, into a cookie.
    if (!token_.empty() && request.path == "/" && request.has_param("token")) {
      response.set_header("Set-Cookie",
                          fmt::format("{}={}; Path=/; HttpOnly; SameSite=Lax", cookie_name(), token_));
      response.set_redirect("/", 303);
      return;
    }
    Request asked{request.path, {}};
    for (const auto& [key, value] : request.params) asked.query.emplace(key, value);
    if (request.method == "GET")
      if (std::shared_ptr<Stream> stream = site_->events(asked)) return send(response, std::move(stream));
    send(response, site_->get(asked));
  }

  const Settings settings_;
  std::string token_;
  httplib::Server server_;
  int port_ = -1;
  Site* site_ = nullptr;
  std::atomic<int> open_ = 0;
  std::atomic<bool> ended_ = false;
  std::thread thread_;
};

Server::Server(const Settings& settings) : implementation_(std::make_unique<Implementation>(settings)) {}
Server::~Server() = default;

std::string Server::url() const {
  return implementation_->url();
}
int Server::port() const {
  return implementation_->port();
}
const std::string& Server::token() const {
  return implementation_->token();
}
void Server::serve(Site& site) {
  implementation_->serve(site);
}
int Server::connections() const {
  return implementation_->connections();
}
void Server::stop() {
  implementation_->stop();
}

}  // namespace amble::serving
