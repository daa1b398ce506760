#include "amble/serving/server.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <atomic>
#include <chrono>
#include <deque>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

#include "amble/core/error.hpp"
#include "tests/serving/connection.hpp"

namespace amble::serving {
namespace {

using namespace std::chrono_literals;
using test::Connection;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// Counts up, an event every 20 ms, to `last`; −1: for ever, in long texts.
class Counting : public Stream {
 public:
  Counting(int last, std::atomic<int>& open) : last_(last), open_(open) { ++open_; }
  ~Counting() override { --open_; }
  std::optional<std::string> next(std::chrono::milliseconds) override {
    if (last_ == -1) return std::string(1 << 20, 'x');
    if (last_ == -2) throw std::runtime_error("a stream that breaks");
    if (at_ > last_) return std::nullopt;
    std::this_thread::sleep_for(5ms);
    return "data: " + std::to_string(at_++) + "\n\n";
  }

 private:
  int last_, at_ = 0;
  std::atomic<int>& open_;
};

/// Says nothing, as a run whose generations take long.
class Silent : public Stream {
 public:
  explicit Silent(std::atomic<int>& open) : open_(open) { ++open_; }
  ~Silent() override { --open_; }
  std::optional<std::string> next(std::chrono::milliseconds longest) override {
    std::this_thread::sleep_for(std::min<std::chrono::milliseconds>(longest, 50ms));
    return "";
  }

 private:
  std::atomic<int>& open_;
};

class Example : public Site {
 public:
  Answer get(const Request& request) override {
    if (request.path == "/")
      return {.type = "text/html", .body = std::make_shared<std::string>(100'000, 'p')};
    if (request.path == "/page")
      return {.type = "text/html", .body = std::make_shared<std::string>("p"), .scripts = "'sha256-1234'"};
    if (request.path == "/throws") throw std::runtime_error("a reason");
    if (request.path == "/echo") return text_answer(200, request.value("said"));
    return text_answer(404, "nothing here");
  }
  std::unique_ptr<Stream> events(const Request& request) override {
    if (request.path == "/count") return std::make_unique<Counting>(50, open);
    if (request.path == "/endless") return std::make_unique<Counting>(-1, open);
    if (request.path == "/breaks") return std::make_unique<Counting>(-2, open);
    if (request.path == "/silent") return std::make_unique<Silent>(open);
    return nullptr;
  }
  std::atomic<int> open = 0;
};

struct Served {
  explicit Served(const Settings& settings = {}) : server(settings) { server.serve(site); }
  httplib::Client client() const { return httplib::Client("127.0.0.1", server.port()); }
  Example site;
  Server server;
};

/// Waits until something holds, ten seconds at most.
template <typename Condition>
bool soon(Condition condition) {
  for (int i = 0; i < 1000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

std::string refusal(const Settings& settings) {
  try {
    const Server server(settings);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

TEST(Server, AnswersAtAFreePortOfTheLoopbackAddress) {
  const Served served;
  EXPECT_EQ(served.server.url(), "http://127.0.0.1:" + std::to_string(served.server.port()) + "/");
  const auto page = served.client().Get("/");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->status, 200);
  EXPECT_EQ(page->body, std::string(100'000, 'p'));
  EXPECT_EQ(served.client().Get("/echo?said=a%20b")->body, "a b");
  EXPECT_EQ(served.client().Get("/other")->status, 404);
}

TEST(Server, ForbidsWhatPagesNeedNot) {
  const Served served;
  for (const char* path : {"/", "/other", "/throws"}) {
    const auto answer = served.client().Get(path);
    EXPECT_THAT(answer->get_header_value("Content-Security-Policy"),
                AllOf(StartsWith("default-src 'none'; script-src 'none'; "), HasSubstr("connect-src 'self'"),
                      HasSubstr("frame-ancestors 'none'")));
    EXPECT_EQ(answer->get_header_value("X-Content-Type-Options"), "nosniff");
    EXPECT_EQ(answer->get_header_value("Referrer-Policy"), "no-referrer");
    EXPECT_EQ(answer->get_header_value("Cross-Origin-Resource-Policy"), "same-origin");
    EXPECT_EQ(answer->get_header_value("Cache-Control"), "no-store");
    EXPECT_FALSE(answer->has_header("Access-Control-Allow-Origin"));
  }
}

TEST(Server, LetsAPageRunTheScriptsThatItNamesAndNoOthers) {
  const Served served;
  const auto answer = served.client().Get("/page");
  ASSERT_EQ(answer->get_header_value_count("Content-Security-Policy"), 1u);
  EXPECT_THAT(answer->get_header_value("Content-Security-Policy"),
              StartsWith("default-src 'none'; script-src 'sha256-1234'; style-src "));
}

TEST(Server, HeadHasTheHeadersAlone) {
  const Served served;
  const auto answer = served.client().Head("/");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  EXPECT_EQ(answer->get_header_value("Content-Length"), "100000");
  EXPECT_TRUE(answer->body.empty());
  EXPECT_EQ(Connection(served.server.port(), "HEAD", "/count").all().find("data: 0"), std::string::npos);
}

TEST(Server, IsReadOnly) {
  const Served served;
  for (const char* method : {"POST", "PUT", "PATCH", "DELETE", "OPTIONS"}) {
    Connection connection(served.server.port(), method, "/echo?said=x", "Content-Length: 1\r\n");
    EXPECT_THAT(connection.all(), AllOf(StartsWith("HTTP/1.1 405 "), HasSubstr("Allow: GET, HEAD")))
        << method;
  }
}

TEST(Server, IsNotThereUnderAnotherNameOfTheComputer) {
  const Served served;
  const std::string port = ":" + std::to_string(served.server.port());
  for (const std::string host : {"evil.example", "evil.example:80", "localhost.evil.example", ""})
    EXPECT_EQ(served.client().Get("/", {{"Host", host}})->status, 403) << host;
  for (const std::string host : {"localhost", "127.0.0.1", "[::1]"})
    EXPECT_EQ(served.client().Get("/", {{"Host", host + port}})->status, 200) << host;
  Connection twice(served.server.port());
  twice.say("GET / HTTP/1.1\r\nHost: localhost\r\nHost: evil.example\r\n\r\n");
  EXPECT_THAT(twice.all(), StartsWith("HTTP/1.1 403 "));
  Connection without(served.server.port());
  without.say("GET / HTTP/1.1\r\n\r\n");
  EXPECT_THAT(without.all(), StartsWith("HTTP/1.1 403 "));
}

TEST(Server, IsNotForPagesFromElsewhereButForLinksToIt) {
  const Served served;
  EXPECT_EQ(
      served.client().Get("/echo", {{"Sec-Fetch-Site", "cross-site"}, {"Sec-Fetch-Mode", "no-cors"}})->status,
      403);
  EXPECT_EQ(
      served.client().Get("/", {{"Sec-Fetch-Site", "cross-site"}, {"Sec-Fetch-Mode", "navigate"}})->status,
      200);
  EXPECT_EQ(
      served.client().Get("/echo", {{"Sec-Fetch-Site", "same-origin"}, {"Sec-Fetch-Mode", "cors"}})->status,
      200);
}

TEST(Server, AtAnotherAddressAsksForItsToken) {
  const Served served({.address = "127.0.0.1"});
  const std::string token = served.server.token();
  ASSERT_EQ(token.size(), 32U);
  EXPECT_THAT(served.server.url(), testing::EndsWith("/?token=" + token));
  for (const std::string& path : {std::string("/"), std::string("/count"), "/?token=" + token.substr(1),
                                  "/?token=" + std::string(32, '0'), std::string("/?token=")}) {
    const auto answer = served.client().Get(path);
    EXPECT_EQ(answer->status, 401) << path;
    EXPECT_THAT(answer->body, Not(HasSubstr(token)));
  }
  EXPECT_EQ(served.client().Get("/echo?said=x&token=" + token)->body, "x");
  const auto first = served.client().Get("/?token=" + token);
  EXPECT_EQ(first->status, 303);
  EXPECT_EQ(first->get_header_value("Location"), "/");
  const std::string cookie = first->get_header_value("Set-Cookie");
  EXPECT_THAT(cookie, AllOf(HasSubstr("HttpOnly"), HasSubstr("SameSite=Lax")));
  EXPECT_EQ(served.client().Get("/", {{"Cookie", cookie.substr(0, cookie.find(';'))}})->status, 200);
  EXPECT_EQ(served.client()
                .Get("/", {{"Host", "robot-lab"}, {"Cookie", cookie.substr(0, cookie.find(';'))}})
                ->status,
            200);
}

TEST(Server, SendsEventsInOrderAsTheyComeAndUncompressed) {
  Served served;
  Connection page(served.server.port(), "GET", "/count", "Accept-Encoding: gzip, br\r\n");
  ASSERT_TRUE(page.hears("data: 3\n\n"));
  EXPECT_THAT(page.heard(), Not(HasSubstr("data: 50\n")));
  const std::string all = page.all();
  EXPECT_THAT(all, AllOf(HasSubstr("Content-Type: text/event-stream"), Not(HasSubstr("Content-Encoding"))));
  std::size_t at = 0;
  for (int i = 0; i <= 50; ++i) {
    at = all.find("data: " + std::to_string(i) + "\n\n", at);
    ASSERT_NE(at, std::string::npos) << i;
  }
  EXPECT_TRUE(soon([&] { return served.site.open == 0; }));
}

TEST(Server, APageThatIsKilledLeavesNothing) {
  Served served;
  {
    std::deque<Connection> pages;
    for (int i = 0; i < 8; ++i)
      pages.emplace_back(served.server.port(), "GET", i % 2 == 0 ? "/silent" : "/endless");
    for (auto& page : pages) ASSERT_TRUE(page.hears("\r\n\r\n"));
    EXPECT_EQ(served.site.open, 8);
  }
  EXPECT_TRUE(soon([&] { return served.site.open == 0 && served.server.connections() == 0; }));
}

TEST(Server, APageThatTakesNothingIsLetGo) {
  Served served;
  Connection page(served.server.port(), "GET", "/endless");
  ASSERT_TRUE(page.hears("\r\n\r\n"));
  EXPECT_TRUE(soon([&] { return served.site.open == 0; }));
}

TEST(Server, The33rdConnectionIsToldSoAndThe33rdAgainOnceOneIsClosed) {
  Served served;
  std::deque<Connection> pages;
  for (int i = 0; i < 32; ++i) pages.emplace_back(served.server.port(), "GET", "/silent");
  for (auto& page : pages) ASSERT_TRUE(page.hears("\r\n\r\n"));
  for (int i = 0; i < 3; ++i) {
    const auto answer = served.client().Get("/");
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, 503);
    EXPECT_THAT(answer->body, HasSubstr("32 connections are open already"));
    EXPECT_EQ(answer->get_header_value("Retry-After"), "5");
  }
  pages.pop_front();
  EXPECT_TRUE(soon([&] { return served.client().Get("/")->status == 200; }));
}

TEST(Server, ConnectionsThatSayNothingAreClosed) {
  Served served;
  Connection silent(served.server.port());
  EXPECT_EQ(silent.all(), "");
  Connection half(served.server.port());
  half.say("GET / HTT");
  EXPECT_THAT(half.all(), Not(HasSubstr("200")));
  EXPECT_TRUE(soon([&] { return served.server.connections() == 0; }));
}

TEST(Server, WhatASiteThrowsIsAnAnswerAndWhatAStreamThrowsEndsIt) {
  Served served;
  EXPECT_EQ(served.client().Get("/throws")->status, 500);
  EXPECT_THAT(Connection(served.server.port(), "GET", "/breaks").all(), HasSubstr("200"));
  EXPECT_EQ(served.client().Get("/echo?said=still")->body, "still");
  EXPECT_EQ(served.site.open, 0);
}

TEST(Server, APortInUseIsNotShared) {
  const Served served;
  const int port = served.server.port();
  EXPECT_EQ(refusal({.port = port}), "--port " + std::to_string(port) +
                                         ": in use at 127.0.0.1; name another, or none, for a free one");
}

TEST(Server, APortIsFreeAgainAfterwards) {
  int port = 0;
  {
    const Served served;
    port = served.server.port();
    served.client().Get("/");
  }
  EXPECT_EQ(refusal({.port = port}), "");
}

TEST(Server, AnAddressThatIsNotHereIsRefused) {
  EXPECT_EQ(refusal({.address = "192.0.2.1"}), "--address 192.0.2.1: not an address of this computer");
  EXPECT_THAT(refusal({.address = "no address\n"}), StartsWith("--address no address\\x0a: no such address"));
}

TEST(Server, StopsWhilePagesAreOpen) {
  auto served = std::make_unique<Served>();
  Connection page(served->server.port(), "GET", "/silent");
  ASSERT_TRUE(page.hears("\r\n\r\n"));
  served->server.stop();
  EXPECT_EQ(served->site.open, 0);
  EXPECT_FALSE(Connection(served->server.port()).connected());
}

}  // namespace
}  // namespace amble::serving
