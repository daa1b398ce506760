#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include "amble/core/error.hpp"
#include "tests/cli/process.hpp"

namespace amble::tests {
namespace {

using Arguments = std::vector<std::string>;

constexpr int ok = static_cast<int>(ExitCode::ok), interrupted = static_cast<int>(ExitCode::interrupted),
              locked = static_cast<int>(ExitCode::locked), differs = static_cast<int>(ExitCode::differs);

/// A run of a second or two: small population, short trials.
Arguments evolve(const std::string& out, int generations, int jobs) {
  return {"evolve",        std::string(AMBLE_SOURCE_DIR) + "/configs/authors/supg-objective.toml",
          "--set",         "population.size=40",
          "--set",         "trial.duration_s=1",
          "--seed",        "1",
          "--generations", std::to_string(generations),
          "--jobs",        std::to_string(jobs),
          "--out",         out};
}

/// Waits until the run's table has that many generations.
void wait_for_rows(const std::filesystem::path& run, long rows) {
  for (int i = 0; i < 6000; ++i) {
    const auto csv = slurp(run / "generations.csv");
    if (std::count(csv.begin(), csv.end(), '\n') > rows) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  FAIL() << "no progress";
}

TEST(Run, GivesTheSameBytesForOneTwoAndFiveWorkers) {
  const ScratchFolder scratch;
  for (const int jobs : {1, 2, 5}) {
    const auto run = amble(evolve(scratch / std::to_string(jobs), 6, jobs));
    ASSERT_EQ(run.exit_code, ok) << run.err;
  }
  for (const char* other : {"2", "5"}) {
    EXPECT_EQ(without_times(slurp(scratch.path / "1/generations.csv")),
              without_times(slurp(scratch.path / other / "generations.csv")));
    EXPECT_EQ(all_champions(scratch.path / "1"), all_champions(scratch.path / other));
  }
}

TEST(Run, GivesTheSameBytesAfterKill9AndResume) {
  const ScratchFolder scratch;
  ASSERT_EQ(amble(evolve(scratch / "whole", 12, 2)).exit_code, ok);
  {
    Process victim(evolve(scratch / "killed", 12, 2));
    wait_for_rows(scratch.path / "killed", 4);
    victim.signal(SIGKILL);
    EXPECT_EQ(victim.wait().signal, SIGKILL);
  }
  const auto resumed = amble({"resume", scratch / "killed", "--jobs", "1"});
  ASSERT_EQ(resumed.exit_code, ok) << resumed.err;
  EXPECT_EQ(without_times(slurp(scratch.path / "whole/generations.csv")),
            without_times(slurp(scratch.path / "killed/generations.csv")));
  EXPECT_EQ(all_champions(scratch.path / "whole"), all_champions(scratch.path / "killed"));
}

TEST(Run, CanBeMadeLongerToTheBitsOfALongRun) {
  const ScratchFolder scratch;
  ASSERT_EQ(amble(evolve(scratch / "long", 7, 2)).exit_code, ok);
  ASSERT_EQ(amble(evolve(scratch / "short", 3, 2)).exit_code, ok);
  const auto resumed = amble({"resume", scratch / "short", "--generations", "7"});
  ASSERT_EQ(resumed.exit_code, ok) << resumed.err;
  EXPECT_EQ(without_times(slurp(scratch.path / "long/generations.csv")),
            without_times(slurp(scratch.path / "short/generations.csv")));
  EXPECT_EQ(all_champions(scratch.path / "long"), all_champions(scratch.path / "short"));
}

class StopSignal : public testing::TestWithParam<int> {};

TEST_P(StopSignal, EndsARunWithItsOwnExitCodeAndACheckpointToGoOnFrom) {
  const ScratchFolder scratch;
  Process process(evolve(scratch / "run", 100000, 1));
  wait_for_rows(scratch.path / "run", 2);
  process.signal(GetParam());
  const auto finished = process.wait();
  EXPECT_EQ(finished.exit_code, interrupted);
  EXPECT_NE(finished.err.find("go on by: amble resume " + scratch / "run"), std::string::npos)
      << finished.err;
  const auto csv = slurp(scratch.path / "run/generations.csv");
  const auto rows = std::count(csv.begin(), csv.end(), '\n') - 1;
  const auto resumed = amble({"resume", scratch / "run", "--generations", std::to_string(rows + 1)});
  EXPECT_EQ(resumed.exit_code, ok) << resumed.err;
}

INSTANTIATE_TEST_SUITE_P(Run, StopSignal, testing::Values(SIGINT, SIGTERM, SIGUSR1));

TEST(Run, IsLeftAloneByASecondProcess) {
  const ScratchFolder scratch;
  Process first(evolve(scratch / "run", 100000, 1));
  wait_for_rows(scratch.path / "run", 1);
  const auto second = amble({"resume", scratch / "run"});
  EXPECT_EQ(second.exit_code, locked);
  EXPECT_NE(second.err.find("in use by another process"), std::string::npos) << second.err;
  first.signal(SIGTERM);
  EXPECT_EQ(first.wait().exit_code, interrupted);
}

TEST(Verify, AgreesOnAnUntouchedRunAndNamesTheStepAfterOneWeightIsAltered) {
  const ScratchFolder scratch;
  ASSERT_EQ(amble(evolve(scratch / "run", 4, 2)).exit_code, ok);
  const auto untouched = amble({"verify", scratch / "run"});
  EXPECT_EQ(untouched.exit_code, ok) << untouched.out;
  EXPECT_EQ(untouched.out.find("differs"), std::string::npos) << untouched.out;

  const auto champion = std::filesystem::directory_iterator(scratch.path / "run/champions")->path();
  auto text = slurp(champion);
  const auto weight = text.find("\"weight\": ");
  ASSERT_NE(weight, std::string::npos);
  const auto end = text.find_first_of(",}\n", weight);
  spill(champion, text.replace(weight, end - weight, "\"weight\": 0.75"));
  const auto altered = amble({"verify", scratch / "run"});
  EXPECT_EQ(altered.exit_code, differs);
  EXPECT_NE(
      altered.out.find(champion.string() + " differs: the file was altered (checksum); first differing step"),
      std::string::npos)
      << altered.out;
}

TEST(Referees, AreShownByInfoTrialAndCompare) {
  const ScratchFolder scratch;
  auto arguments = evolve(scratch / "run", 2, 2);
  arguments.insert(arguments.end(), {"--set", "referees=[\"mujoco\"]"});
  const auto run = amble(arguments);
  ASSERT_EQ(run.exit_code, ok) << run.err;
  EXPECT_EQ(amble({"verify", scratch / "run"}).exit_code, ok);
  const auto champion = std::filesystem::directory_iterator(scratch.path / "run/champions")->path().string();

  const auto trial = amble({"trial", champion, "--engine", "mujoco"});
  EXPECT_NE(trial.out.find("engine    mujoco (evolved in ode)\n"), std::string::npos) << trial.out;
  const auto label = trial.out.find("distance  ");
  ASSERT_NE(label, std::string::npos);
  const auto distance = trial.out.substr(label + 10, trial.out.find('\n', label) - label - 10);

  const auto info = amble({"info", champion});
  EXPECT_NE(info.out.find("in mujoco   " + distance), std::string::npos) << info.out;
  const auto table = amble({"compare", champion, "--seconds", "1,2", "--engines", "mujoco"});
  ASSERT_EQ(table.exit_code, ok) << table.err;
  EXPECT_EQ(std::count(table.out.begin(), table.out.end(), '\n'), 5) << table.out;
  EXPECT_NE(table.out.find(distance.substr(0, distance.find(' '))), std::string::npos) << table.out;
  EXPECT_NE(table.out.find("home"), std::string::npos) << table.out;
}

TEST(Trial, RecordsWhatInfoAndPageCanRead) {
  const ScratchFolder scratch;
  ASSERT_EQ(amble(evolve(scratch / "run", 2, 2)).exit_code, ok);
  const auto champion = std::filesystem::directory_iterator(scratch.path / "run/champions")->path().string();
  const auto trial = amble({"trial", champion, "--seconds", "2", "--record", scratch / "walk.rec"});
  ASSERT_EQ(trial.exit_code, ok) << trial.err;
  EXPECT_NE(trial.out.find("distance"), std::string::npos);
  const auto info = amble({"info", scratch / "walk.rec"});
  EXPECT_EQ(info.exit_code, ok) << info.err;
  EXPECT_NE(info.out.find("trigger.FL"), std::string::npos) << info.out;
  const auto page =
      amble({"page", scratch / "run", "-o", scratch / "page.html", "--figures", scratch / "figures"});
  EXPECT_EQ(page.exit_code, ok) << page.err;
  EXPECT_TRUE(std::filesystem::exists(scratch.path / "figures/footfalls.svg"));
  EXPECT_NE(slurp(scratch.path / "page.html").find("</html>"), std::string::npos);
}

}  // namespace
}  // namespace amble::tests
