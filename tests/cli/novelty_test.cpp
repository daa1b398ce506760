#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "tests/cli/process.hpp"

namespace amble::tests {
namespace {

/// A run of novelty search of a second or two, whose archive grows in most generations.
std::vector<std::string> evolve(const std::string& out, int generations, int jobs,
                                const std::string& preset = "authors", const std::string& threshold = "1") {
  return {"evolve",        std::string(AMBLE_SOURCE_DIR) + "/configs/" + preset + "/supg-novelty.toml",
          "--set",         "population.size=40",
          "--set",         "trial.duration_s=1",
          "--set",         "search.novelty.threshold=" + threshold,
          "--seed",        "1",
          "--generations", std::to_string(generations),
          "--jobs",        std::to_string(jobs),
          "--out",         out};
}

/// Everything of a run that must repeat.
std::string results(const std::filesystem::path& run) {
  return without_times(slurp(run / "generations.csv")) + all_champions(run) + slurp(run / "archive.bin");
}

/// A variable of the environment that processes started meanwhile see.
class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) { setenv(name, value, 1); }
  ~Environment() { unsetenv(name_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
};

TEST(NoveltyRun, GivesTheSameBytesForOneTwoAndFiveWorkers) {
  for (const char* preset : {"authors", "paper"}) {
    const TemporaryFolder scratch;
    for (const int jobs : {1, 2, 5}) {
      const auto run = amble(evolve(scratch / std::to_string(jobs), 5, jobs, preset));
      ASSERT_EQ(run.exit_code, 0) << run.err;
    }
    EXPECT_GT(slurp(scratch / "1/archive.bin").size(), 16 + 30 * (100 * 4 + 8)) << "hardly an archive";
    EXPECT_TRUE(results(scratch / "1") == results(scratch / "2"));
    EXPECT_TRUE(results(scratch / "1") == results(scratch / "5"));
  }
}

TEST(NoveltyRun, GivesTheSameBytesAfterBeingKilledAgainAndAgain) {
  const TemporaryFolder scratch;
  ASSERT_EQ(amble(evolve(scratch / "whole", 14, 2)).exit_code, 0);
  const auto killed = scratch / "killed";
  auto arguments = evolve(killed.string(), 14, 2);
  // At moments that have nothing to do with generations.
  for (const int milliseconds : {170, 230, 110, 190}) {
    Process victim(arguments);
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    victim.signal(SIGKILL);
    victim.wait();
    // What has no config is no run yet, and a start may begin there again.
    if (std::filesystem::exists(killed / "config.toml")) arguments = {"resume", killed.string()};
  }
  const auto last = amble(arguments);
  ASSERT_EQ(last.exit_code, 0) << last.err;
  EXPECT_TRUE(results(killed) == results(scratch / "whole"));
}

TEST(NoveltyRun, GivesTheSameBytesWhateverKernelsAndThreadsTheMatrixProductUses) {
  const TemporaryFolder scratch;
  ASSERT_EQ(amble(evolve(scratch / "plain", 4, 1)).exit_code, 0);
  {
    const Environment old_cpu("OPENBLAS_CORETYPE", "Prescott"), threads("OPENBLAS_NUM_THREADS", "4");
    ASSERT_EQ(amble(evolve(scratch / "old", 4, 1)).exit_code, 0);
  }
  EXPECT_TRUE(results(scratch / "plain") == results(scratch / "old"));
}

TEST(NoveltyRun, TellsOfItsArchive) {
  const TemporaryFolder scratch;
  ASSERT_EQ(amble(evolve(scratch / "run", 1, 2, "authors", "1e12")).exit_code, 0);
  const auto info = amble({"info", scratch / "run"});
  EXPECT_EQ(info.exit_code, 0) << info.err;
  EXPECT_NE(info.out.find(
                "search      novelty: archive of 15 behaviours, threshold 1e+12 in the last generation\n"),
            std::string::npos)
      << info.out;
}

}  // namespace
}  // namespace amble::tests
