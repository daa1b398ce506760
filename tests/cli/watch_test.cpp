// Pages of runs that go on: `evolve --watch`, `resume --watch`, `study --watch`, `view --live`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include "amble/core/error.hpp"
#include "tests/cli/process.hpp"
#include "tests/cli/study_fixture.hpp"
#include "tests/serving/connection.hpp"

namespace amble::tests {
namespace watch_test {

using test::Connection;
using testing::AllOf;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::StartsWith;

constexpr int ok = static_cast<int>(ExitCode::ok), bad_input = static_cast<int>(ExitCode::bad_input),
              interrupted = static_cast<int>(ExitCode::interrupted);

/// A port of the loopback address, taken as long as this lives unless it is let go.
class Port {
 public:
  Port() : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = ::htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(at);
    EXPECT_EQ(::bind(fd_, reinterpret_cast<const sockaddr*>(&at), size), 0);
    EXPECT_EQ(::listen(fd_, 1), 0);
    EXPECT_EQ(::getsockname(fd_, reinterpret_cast<sockaddr*>(&at), &size), 0);
    number_ = ::ntohs(at.sin_port);
  }
  ~Port() { let_go(); }
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;
  int let_go() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
    return number_;
  }
  std::string text() const { return std::to_string(number_); }

 private:
  int fd_, number_ = 0;
};

std::vector<std::string> evolve(const std::string& out, int generations, std::vector<std::string> more = {}) {
  std::vector<std::string> words{"evolve",        AMBLE_SOURCE_DIR "/configs/quick/quadruped.toml",
                                 "--set",         "population.size=40",
                                 "--set",         "trial.duration_s=1",
                                 "--generations", std::to_string(generations),
                                 "--jobs",        "1",
                                 "--out",         out};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// Waits until a port answers.
void wait_for(int port) {
  for (int i = 0; i < 3000 && !Connection(port).connected(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

TEST(Watching, ARunTellsItsGenerationsAndItsEndAndIsTheSameRun) {
  const TemporaryFolder scratch;
  const int port = Port().let_go();
  Process run(evolve(scratch / "watched", 30, {"--watch", "--port", std::to_string(port)}));
  wait_for(port);
  Connection page(port, "GET", "/events?run=.");
  EXPECT_TRUE(page.hears("event: rows"));
  EXPECT_TRUE(page.hears("event: end\ndata: {\"text\":\"The run has ended; its files are in " +
                         (scratch / "watched").string() + "\"}\n\n"));
  const std::string heard = page.all();
  EXPECT_THAT(heard, AllOf(HasSubstr("\"29,"), HasSubstr("\"done\":30")));
  const auto finished = run.wait();
  EXPECT_EQ(finished.exit_code, ok) << finished.err;
  EXPECT_THAT(finished.err, HasSubstr("watch it at http://127.0.0.1:" + std::to_string(port) + "/\n"));
  ASSERT_EQ(amble(evolve(scratch / "alone", 30)).exit_code, ok);
  EXPECT_EQ(without_times(slurp(scratch / "watched/generations.csv")),
            without_times(slurp(scratch / "alone/generations.csv")));
  EXPECT_EQ(all_champions(scratch / "watched"), all_champions(scratch / "alone"));
}

TEST(Watching, ARunThatIsStoppedTellsSoAndIsResumedWithAPage) {
  const TemporaryFolder scratch;
  const int port = Port().let_go();
  const std::vector<std::string> watched{"--watch", "--port", std::to_string(port)};
  Process run(evolve(scratch / "run", 100'000, watched));
  wait_for(port);
  Connection page(port, "GET", "/events?run=.");
  ASSERT_TRUE(page.hears("event: rows"));
  run.signal(SIGINT);
  EXPECT_TRUE(page.hears("The run was stopped at generation "));
  EXPECT_EQ(run.wait().exit_code, interrupted);
  Process resumed({"resume", scratch / "run", "--watch", "--port", std::to_string(port)});
  wait_for(port);
  EXPECT_TRUE(Connection(port, "GET", "/events?run=.").hears("\"stage\":\"running\""));
  Connection champion(port, "GET", "/champion?run=.");
  EXPECT_THAT(champion.all(), AllOf(StartsWith("HTTP/1.1 200"), HasSubstr("\"format\": \"amble-champion\"")));
  resumed.signal(SIGINT);
  EXPECT_EQ(resumed.wait().exit_code, interrupted);
}

using WatchedStudy = Study;

TEST_F(WatchedStudy, TellsAllItsRunsAndItsEndAndHasTheSameLedger) {
  for (const char* jobs : {"1", "2"}) {
    const std::string name = std::string("watched-") + jobs;
    const int port = Port().let_go();
    Process run(command(name, {"--jobs", jobs, "--watch", "--port", std::to_string(port)}));
    wait_for(port);
    Connection page(port, "GET", "/events?run=runs/supg-001");
    EXPECT_TRUE(
        page.hears("event: end\ndata: {\"text\":\"The study has ended; for its report, run: amble report "));
    const std::string heard = page.all();
    EXPECT_THAT(heard, AllOf(HasSubstr("\"planned\":6"), HasSubstr("\"recorded\":6"), HasSubstr("\"3,")));
    for (const char* condition : {"supg", "sine"})
      for (const char* seed : {"001", "002", "003"})
        EXPECT_THAT(heard, HasSubstr(std::string("\"id\":\"runs/") + condition + "-" + seed + "\""));
    const auto finished = run.wait();
    EXPECT_EQ(finished.exit_code, ok) << finished.err;
    EXPECT_THAT(finished.err, HasSubstr("watch it at http://127.0.0.1:" + std::to_string(port) + "/\n"));
    EXPECT_EQ(digest(finished), digest(study("alone")));
  }
}

TEST_F(WatchedStudy, ThatIsStoppedTellsSo) {
  write(replaced(study_toml, "generations = 4", "generations = 100000"));
  const int port = Port().let_go();
  Process run(command("stopped", {"--jobs", "2", "--watch", "--port", std::to_string(port)}));
  wait_for(port);
  Connection page(port, "GET", "/events");
  ASSERT_TRUE(page.hears("\"stage\":\"running\""));
  run.signal(SIGINT);
  EXPECT_TRUE(page.hears("The study was stopped; to continue, run the same command."));
  EXPECT_EQ(run.wait().exit_code, interrupted);
}

TEST(Watching, APortInUseIsToldBeforeAnythingIsWritten) {
  const TemporaryFolder scratch;
  const Port taken;
  const auto refused = amble(evolve(scratch / "run", 3, {"--watch", "--port", taken.text()}));
  EXPECT_EQ(refused.exit_code, bad_input);
  EXPECT_EQ(refused.err, "amble: --port " + taken.text() +
                             ": in use at 127.0.0.1; name another, or none, for a free one\n");
  EXPECT_FALSE(std::filesystem::exists(scratch / "run"));
  const auto free = amble(evolve(scratch / "run", 3, {"--watch"}));
  EXPECT_EQ(free.exit_code, ok);
  EXPECT_THAT(free.err, HasSubstr("watch it at http://127.0.0.1:"));
}

TEST(Watching, AnAddressNeedsTheTokenThatIsPrinted) {
  const TemporaryFolder scratch;
  const int port = Port().let_go();
  Process run(evolve(scratch / "run", 100'000,
                     {"--watch", "--address", "127.0.0.1", "--port", std::to_string(port)}));
  wait_for(port);
  EXPECT_THAT(Connection(port, "GET", "/runs").all(), StartsWith("HTTP/1.1 401"));
  run.signal(SIGINT);
  const auto finished = run.wait();
  EXPECT_EQ(finished.exit_code, interrupted);
  const std::string url = "http://127.0.0.1:" + std::to_string(port) + "/?token=";
  const std::size_t at = finished.err.find(url);
  ASSERT_NE(at, std::string::npos) << finished.err;
  EXPECT_THAT(finished.err.substr(at + url.size(), 33), MatchesRegex("[0-9a-f]+\n"));
}

TEST(Watching, AFolderIsWatchedFromOutsideAndTellsItsEndAndThatItVanishes) {
  const TemporaryFolder scratch;
  const int port = Port().let_go();
  ASSERT_EQ(amble(evolve(scratch / "run", 3)).exit_code, ok);
  Process view({"view", "--live", scratch / "run", "--port", std::to_string(port)});
  wait_for(port);
  Connection page(port, "GET", "/events?run=.");
  ASSERT_TRUE(page.hears("\"stage\":\"ended\""));
  ASSERT_EQ(amble({"resume", scratch / "run", "--generations", "6"}).exit_code, ok);
  ASSERT_TRUE(page.hears("\"done\":6"));
  std::filesystem::remove_all(scratch / "run");
  ASSERT_TRUE(page.hears("\"gone\":true"));
  std::this_thread::sleep_for(std::chrono::seconds(1));
  EXPECT_TRUE(view.running());
  EXPECT_THAT(Connection(port, "GET", "/").all(), HasSubstr("<!DOCTYPE html>"));
  view.signal(SIGINT);
  EXPECT_TRUE(page.hears("event: end"));
  const auto finished = view.wait();
  EXPECT_EQ(finished.exit_code, ok);
  EXPECT_THAT(finished.err,
              HasSubstr((scratch / "run").string() + ": has vanished; its pages show what was known"));
}

TEST(Watching, WhatCannotBeIsToldInALine) {
  const TemporaryFolder scratch;
  const auto refusal = [](const std::vector<std::string>& words) {
    const auto refused = amble(words);
    EXPECT_EQ(refused.exit_code, bad_input);
    EXPECT_EQ(std::ranges::count(refused.err, '\n'), 1) << refused.err;
    return refused.err;
  };
  EXPECT_THAT(refusal({"view", "--live", scratch / "none"}),
              HasSubstr("none: no such folder; expected a run folder or one with run folders in it"));
  EXPECT_THAT(refusal({"view", "--live", scratch.path(), scratch.path()}),
              HasSubstr("--live: expected one folder"));
  EXPECT_THAT(refusal({"view", "--live", scratch.path(), "-o", "page.html"}),
              AllOf(HasSubstr("--live"), HasSubstr("--out")));
  EXPECT_THAT(refusal({"view", scratch.path()}), HasSubstr("--out"));
  EXPECT_THAT(refusal({"view", scratch.path(), "-o", "page.html", "--port", "8000"}), HasSubstr("--live"));
  EXPECT_THAT(refusal(evolve(scratch / "run", 3, {"--port", "8000"})), HasSubstr("--watch"));
  EXPECT_THAT(refusal(evolve(scratch / "run", 3, {"--watch", "--port", "0"})),
              HasSubstr("expected a whole number from 1 to 65535"));
  EXPECT_THAT(refusal(evolve(scratch / "run", 3, {"--watch", "--address", "192.0.2.1"})),
              HasSubstr("--address 192.0.2.1: not an address of this computer"));
  const auto study = [&scratch](std::vector<std::string> more) {
    std::vector<std::string> words{"study", AMBLE_SOURCE_DIR "/studies/smoke.toml", "--out", scratch / "run"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  EXPECT_THAT(refusal(study({"--watch", "--status"})), AllOf(HasSubstr("--watch"), HasSubstr("--status")));
  EXPECT_THAT(refusal(study({"--watch", "--slurm", scratch / "job.sh"})),
              AllOf(HasSubstr("--watch"), HasSubstr("--slurm")));
  EXPECT_THAT(refusal(study({"--port", "8000"})), HasSubstr("--watch"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "run"));
}

}  // namespace watch_test
}  // namespace amble::tests
