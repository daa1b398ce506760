#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "amble/core/clock.hpp"
#include "tests/cli/process.hpp"
#include "tests/cli/study_fixture.hpp"

namespace amble::tests {
namespace {

#ifdef AMBLE_SANITIZED
constexpr int generations = 12;  // each takes ten times as long
#else
constexpr int generations = 40;
#endif
constexpr int all_generations = 6 * generations;

/// The processes that a process has started.
std::vector<pid_t> children_of(pid_t parent) {
  std::vector<pid_t> children;
  std::istringstream list(slurp(fmt::format("/proc/{0}/task/{0}/children", parent)));
  for (pid_t child = 0; list >> child;) children.push_back(child);
  return children;
}

/// The tables of generations of a study's runs.
std::vector<fs::path> tables(const fs::path& out) {
  std::vector<fs::path> found;
  for (const char* condition : {"supg", "sine"})
    for (int seed = 1; seed <= 3; ++seed)
      found.push_back(out / "runs" / fmt::format("{}-{:03}", condition, seed) / "generations.csv");
  return found;
}

int generations_done(const fs::path& out) {
  std::ptrdiff_t done = 0;
  for (const auto& table : tables(out))
    done += std::max<std::ptrdiff_t>(0, std::ranges::count(slurp(table), '\n') - 1);
  return static_cast<int>(done);
}

/// What a study that is killed now must not do again, as the beginnings of files: its records, and the
/// generations of its runs, with the times that they took, up to the last but one.
std::map<fs::path, std::string> finished_work(const fs::path& out) {
  std::map<fs::path, std::string> beginnings;
  for (const auto& table : tables(out)) {
    const auto text = slurp(table);
    const auto last = text.rfind('\n', text.rfind('\n') - 1);
    if (last != std::string::npos) beginnings[table] = text.substr(0, last + 1);
  }
  if (!fs::exists(out / "ledger")) return beginnings;
  for (const auto& entry : fs::directory_iterator(out / "ledger"))
    if (entry.path().extension() == ".json") beginnings[entry.path()] = slurp(entry.path());
  return beginnings;
}

void expect_kept(const std::map<fs::path, std::string>& beginnings) {
  for (const auto& [path, text] : beginnings)
    EXPECT_TRUE(slurp(path).starts_with(text)) << path << " was made again";
}

/// A study of some seconds, each time in as many processes as the parameter says.
class KilledStudy : public Study, public testing::WithParamInterface<int> {
 protected:
  KilledStudy() {
    write(replaced(study_toml, "generations = 4", fmt::format("generations = {}", generations)));
  }

  std::vector<std::string> options() const { return {"--jobs", std::to_string(GetParam())}; }

  /// Goes on with the study and kills all its processes at once: at a random one of its next generations,
  /// which is such that so many kills lie evenly between here and its end, and up to `most_s` later. Returns
  /// what the study said, and notes how many of its workers were there.
  Finished kill(int kills_left, double most_s) {
    const int done = generations_done(out_);
    const int step = 2 * (all_generations - done) / (kills_left + 1);
    const int target = done + std::uniform_int_distribution(0, std::max(0, step - 1))(random_);
    Process process(command("killed", options()), true);
    while (process.running() && generations_done(out_) < target)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    std::this_thread::sleep_for(
        std::chrono::duration<double>(most_s * std::uniform_real_distribution()(random_)));
    for (const pid_t worker : children_of(process.pid())) {
      const pid_t group = getpgid(worker);
      if (group < 0) continue;  // ended by itself
      EXPECT_EQ(group, process.pid()) << "outlives the kill";
      ++workers_;
    }
    process.signal_group(SIGKILL);
    return process.wait();
  }

  const fs::path out_ = folder_ / "killed";
  std::mt19937 random_{static_cast<unsigned>(GetParam())};
  int workers_ = 0;
};

TEST_P(KilledStudy, GoesOnToTheSameLedgerAndDoesNothingAgain) {
  const double start_s = now_s();
  const auto undisturbed = study("undisturbed", options());
  const double study_s = now_s() - start_s;
  ASSERT_EQ(undisturbed.exit_code, 0) << undisturbed.err;
  constexpr int kills = 10, least_effective = 8;
  int effective = 0;
  std::map<fs::path, std::string> finished;
  for (int i = 0; i < kills; ++i) {
    const auto killed = kill(kills - i, 0.05 * study_s);
    if (killed.signal != SIGKILL) {
      EXPECT_EQ(killed.exit_code, 0) << killed.err;
      break;
    }
    ++effective;
    expect_kept(finished);
    finished = finished_work(out_);
  }
  EXPECT_GE(effective, least_effective) << "the study was over before";
  EXPECT_GE(workers_, GetParam() == 1 ? 0 : least_effective);
  const auto last = study("killed", options());
  EXPECT_EQ(last.exit_code, 0) << last.err;
  EXPECT_EQ(digest(last), digest(undisturbed));
  EXPECT_GE(finished.size(), 4u);
  expect_kept(finished);
}

INSTANTIATE_TEST_SUITE_P(InProcesses, KilledStudy, testing::Values(1, 2, 4));

TEST_F(Study, OneOfWhoseProcessesIsKilledIsDoneByTheOthers) {
  write(replaced(study_toml, "generations = 4", "generations = 20"));
  Process process(command("s", {"--jobs", "2"}));
  const auto begun = folder_ / "s" / "runs" / "supg-001" / "checkpoint.bin";
  std::vector<pid_t> children;
  for (int tries = 0; tries < 4000 && (children.size() < 2 || !fs::exists(begun)); ++tries) {
    children = children_of(process.pid());
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_EQ(children.size(), 2u);
  ::kill(children[0], SIGKILL);
  const auto finished = process.wait();
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_NE(finished.err.find("ended by signal 9"), std::string::npos) << finished.err;
  EXPECT_EQ(digest(finished), digest(study("alone", {"--jobs", "1"})));
}

TEST_F(Study, StoppedByASignalSaysHowToGoOn) {
  write(replaced(study_toml, "generations = 4", "generations = 4000"));
  Process process(command("s", {"--jobs", "2"}));
  while (!fs::exists(folder_ / "s" / "runs" / "supg-001" / "checkpoint.bin"))
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  process.signal(SIGTERM);
  const auto stopped = process.wait();
  EXPECT_EQ(stopped.exit_code, 7) << stopped.err;
  EXPECT_NE(stopped.err.find("to continue, run the same command"), std::string::npos) << stopped.err;
}

}  // namespace
}  // namespace amble::tests
