#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include "amble/core/error.hpp"
#include "amble/io/json_file.hpp"
#include "tests/cli/process.hpp"

namespace amble::tests {
namespace run_test {

using Arguments = std::vector<std::string>;

constexpr int ok = static_cast<int>(ExitCode::ok), interrupted = static_cast<int>(ExitCode::interrupted),
              locked = static_cast<int>(ExitCode::locked), differs = static_cast<int>(ExitCode::differs);

/// A run of a second or two: small population, short trials.
Arguments evolve(const std::string& out, int generations, int jobs, const std::string& engine = "ode") {
  return {"evolve",        std::string(AMBLE_SOURCE_DIR) + "/configs/authors/supg-objective.toml",
          "--set",         "population.size=40",
          "--set",         "trial.duration_s=1",
          "--set",         "engine=" + engine,
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

class RunOnEngine : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Run, RunOnEngine, testing::Values("ode", "batch", "mujoco"),
                         [](const auto& engine) { return std::string(engine.param); });

TEST_P(RunOnEngine, GivesTheSameBytesForOneTwoAndFiveWorkers) {
  const TemporaryFolder scratch;
  for (const int jobs : {1, 2, 5}) {
    const auto run = amble(evolve(scratch / std::to_string(jobs), 6, jobs, GetParam()));
    ASSERT_EQ(run.exit_code, ok) << run.err;
  }
  for (const char* other : {"2", "5"}) {
    EXPECT_EQ(without_times(slurp(scratch / "1/generations.csv")),
              without_times(slurp(scratch / other / "generations.csv")));
    EXPECT_EQ(all_champions(scratch / "1"), all_champions(scratch / other));
  }
}

TEST_P(RunOnEngine, GivesTheSameBytesAfterKill9AndResume) {
  const TemporaryFolder scratch;
  // Long enough that the victim is at work when it is killed.
  const int generations = GetParam() == std::string("batch") ? 100 : 12;
  ASSERT_EQ(amble(evolve(scratch / "whole", generations, 2, GetParam())).exit_code, ok);
  {
    Process victim(evolve(scratch / "killed", generations, 2, GetParam()));
    wait_for_rows(scratch / "killed", 4);
    victim.signal(SIGKILL);
    EXPECT_EQ(victim.wait().signal, SIGKILL);
  }
  const auto resumed = amble({"resume", scratch / "killed", "--jobs", "1"});
  ASSERT_EQ(resumed.exit_code, ok) << resumed.err;
  EXPECT_EQ(without_times(slurp(scratch / "whole/generations.csv")),
            without_times(slurp(scratch / "killed/generations.csv")));
  EXPECT_EQ(all_champions(scratch / "whole"), all_champions(scratch / "killed"));
}

TEST(Run, CanBeMadeLongerToTheBitsOfALongRun) {
  const TemporaryFolder scratch;
  ASSERT_EQ(amble(evolve(scratch / "long", 7, 2)).exit_code, ok);
  ASSERT_EQ(amble(evolve(scratch / "short", 3, 2)).exit_code, ok);
  const auto resumed = amble({"resume", scratch / "short", "--generations", "7"});
  ASSERT_EQ(resumed.exit_code, ok) << resumed.err;
  EXPECT_EQ(without_times(slurp(scratch / "long/generations.csv")),
            without_times(slurp(scratch / "short/generations.csv")));
  EXPECT_EQ(all_champions(scratch / "long"), all_champions(scratch / "short"));
}

class StopSignal : public testing::TestWithParam<int> {};

TEST_P(StopSignal, EndsARunWithItsOwnExitCodeAndACheckpointToGoOnFrom) {
  const TemporaryFolder scratch;
  Process process(evolve(scratch / "run", 100000, 1));
  wait_for_rows(scratch / "run", 2);
  process.signal(GetParam());
  const auto finished = process.wait();
  EXPECT_EQ(finished.exit_code, interrupted);
  EXPECT_NE(finished.err.find("to continue, run: amble resume " + (scratch / "run").string()),
            std::string::npos)
      << finished.err;
  const auto csv = slurp(scratch / "run/generations.csv");
  const auto rows = std::count(csv.begin(), csv.end(), '\n') - 1;
  const auto resumed = amble({"resume", scratch / "run", "--generations", std::to_string(rows + 1)});
  EXPECT_EQ(resumed.exit_code, ok) << resumed.err;
}

INSTANTIATE_TEST_SUITE_P(Run, StopSignal, testing::Values(SIGINT, SIGTERM, SIGUSR1, SIGHUP));

TEST(Run, IsLeftAloneByASecondProcess) {
  const TemporaryFolder scratch;
  Process first(evolve(scratch / "run", 100000, 1));
  wait_for_rows(scratch / "run", 1);
  const auto second = amble({"resume", scratch / "run"});
  EXPECT_EQ(second.exit_code, locked);
  EXPECT_NE(second.err.find("in use by another process"), std::string::npos) << second.err;
  first.signal(SIGTERM);
  EXPECT_EQ(first.wait().exit_code, interrupted);
}

TEST(Info, SaysWhereTheTimeOfARunWent) {
  const TemporaryFolder scratch;
  ASSERT_EQ(amble(evolve(scratch / "run", 2, 1, "batch")).exit_code, ok);
  const auto info = amble({"info", scratch / "run"});
  ASSERT_EQ(info.exit_code, ok) << info.err;
  for (const char* stage : {"\ntime  ", "\n  physics ", "\n  genomes to controllers ", "\n  files "})
    EXPECT_NE(info.out.find(stage), std::string::npos) << stage << info.out;
}

TEST(Verify, AgreesOnAnUntouchedRunAndNamesTheStepAfterOneWeightIsAltered) {
  const TemporaryFolder scratch;
  ASSERT_EQ(amble(evolve(scratch / "run", 4, 2)).exit_code, ok);
  const auto untouched = amble({"verify", scratch / "run"});
  EXPECT_EQ(untouched.exit_code, ok) << untouched.out;
  EXPECT_EQ(untouched.out.find("differs"), std::string::npos) << untouched.out;

  const auto champion = std::filesystem::directory_iterator(scratch / "run/champions")->path();
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

TEST_P(RunOnEngine, HasNoiseOnlyWhereItIsSetAndIsVerified) {
  const TemporaryFolder scratch;
  auto arguments = evolve(scratch / "noisy", 2, 2, GetParam());
  arguments[1] = std::string(AMBLE_SOURCE_DIR) + "/configs/robust/supg-objective.toml";
  ASSERT_EQ(amble(arguments).exit_code, ok);
  const auto verified = amble({"verify", scratch / "noisy"});
  EXPECT_EQ(verified.exit_code, ok) << verified.out;
  EXPECT_NE(verified.out.find("; under noise "), std::string::npos) << verified.out;

  const auto champion = std::filesystem::directory_iterator(scratch / "noisy/champions")->path().string();
  const auto trial = [&](Arguments more) {
    Arguments all{"trial", champion, "--seconds", "2"};
    all.insert(all.end(), more.begin(), more.end());
    const auto run = amble(all);
    EXPECT_EQ(run.exit_code, ok) << run.err;
    return run.out;
  };
  EXPECT_EQ(trial({}), trial({}));
  EXPECT_EQ(trial({"--episode", "1"}), trial({"--episode", "1"}));
  EXPECT_NE(trial({"--episode", "1"}), trial({}));
  EXPECT_NE(trial({"--episode", "1"}), trial({"--episode", "2"}));
  const std::string rough = AMBLE_SOURCE_DIR "/studies/grounds/supg-rough.toml";
  EXPECT_NE(trial({"--episode", "1", "--ground", rough}), trial({"--episode", "1"}));

  EXPECT_NE(trial({"--damage", "missing:FL"}), trial({}));
  EXPECT_EQ(trial({"--damage", "none"}), trial({}));
  const auto refusal = [&](const std::string& damage) {
    return amble({"trial", champion, "--seconds", "2", "--damage", damage}).err;
  };
  EXPECT_NE(refusal("numb:FL@100").find("the trial is 2 s long, and has ended by then"), std::string::npos);
  EXPECT_NE(refusal(rough).find("the config has no [damage]"), std::string::npos);
  const auto unknown = amble({"trial", champion, "--damage", "missing:FX"});
  EXPECT_EQ(unknown.exit_code, static_cast<int>(ExitCode::bad_input));
  EXPECT_NE(unknown.err.find("the robot has no such leg"), std::string::npos) << unknown.err;

  ASSERT_EQ(amble(evolve(scratch / "quiet", 1, 2)).exit_code, ok);
  const auto quiet = std::filesystem::directory_iterator(scratch / "quiet/champions")->path().string();
  EXPECT_TRUE(trial({}).starts_with("typically ")) << trial({});
  EXPECT_NE(trial({}).find(" trials under its own noise "), std::string::npos) << trial({});
  const auto at_level = amble({"trial", quiet, "--trials", "3"});
  EXPECT_NE(at_level.out.find("half of 3 trials at the level milli "), std::string::npos) << at_level.out;
  EXPECT_NE(at_level.out.find("\n\nits trial without noise:\nengine    ode\n"), std::string::npos);
  const auto own = amble({"gait", quiet, "--level", "own"});
  EXPECT_EQ(own.exit_code, static_cast<int>(ExitCode::bad_input));
  EXPECT_NE(own.err.find("evolved without noise"), std::string::npos) << own.err;
  const auto refused = amble({"trial", quiet, "--episode", "0"});
  EXPECT_EQ(refused.exit_code, static_cast<int>(ExitCode::bad_input));
  EXPECT_NE(refused.err.find("was evolved without noise"), std::string::npos) << refused.err;
}

TEST(Referees, AreShownByInfoAndTrialAndLeaveVerifyAlone) {
  const TemporaryFolder scratch;
  auto arguments = evolve(scratch / "run", 2, 2);
  arguments.insert(arguments.end(), {"--set", "engine=batch", "--set", "referees=[\"ode\", \"mujoco\"]"});
  const auto run = amble(arguments);
  ASSERT_EQ(run.exit_code, ok) << run.err;
  const auto verified = amble({"verify", scratch / "run"});
  EXPECT_EQ(verified.exit_code, ok) << verified.out;

  std::string champion;  // the best, which is the last
  for (const auto& file : std::filesystem::directory_iterator(scratch / "run/champions"))
    champion = std::max(champion, file.path().string());
  const auto trial = amble({"trial", champion, "--engine", "mujoco", "--undisturbed"});
  EXPECT_TRUE(trial.out.starts_with("engine    mujoco (evolved in batch)\n")) << trial.out;
  const auto label = trial.out.find("distance  ") + 10;
  const auto distance = trial.out.substr(label, trial.out.find('\n', label) - label);

  const auto info = amble({"info", champion});
  EXPECT_NE(info.out.find("precision   outputs change by at most "), std::string::npos) << info.out;
  EXPECT_NE(info.out.find("in mujoco   " + distance + ", "), std::string::npos) << info.out;
}

TEST_P(RunOnEngine, HasChampionsWhoseRecordingInfoAndPageCanRead) {
  const TemporaryFolder scratch;
  ASSERT_EQ(amble(evolve(scratch / "run", 2, 2, GetParam())).exit_code, ok);
  const auto champion = std::filesystem::directory_iterator(scratch / "run/champions")->path().string();
  const auto trial = amble({"trial", champion, "--seconds", "2", "--record", scratch / "walk.rec"});
  ASSERT_EQ(trial.exit_code, ok) << trial.err;
  EXPECT_NE(trial.out.find("distance"), std::string::npos);
  const auto info = amble({"info", scratch / "walk.rec"});
  EXPECT_EQ(info.exit_code, ok) << info.err;
  EXPECT_NE(info.out.find("trigger.FL"), std::string::npos) << info.out;
  EXPECT_NE(info.out.find("torque.FL_knee"), std::string::npos) << info.out;
  const auto page = amble(
      {"view", scratch / "run", "--static", "-o", scratch / "page.html", "--figures", scratch / "figures"});
  EXPECT_EQ(page.exit_code, ok) << page.err;
  EXPECT_TRUE(std::filesystem::exists(scratch / "figures/footfalls.svg"));
  EXPECT_NE(slurp(scratch / "page.html").find("</html>"), std::string::npos);
}

TEST(View, StaticIsWhatPageMakes) {
  const TemporaryFolder scratch;
  ASSERT_EQ(amble(evolve(scratch / "run", 4, 2)).exit_code, ok);
  const std::string run = scratch / "run", figures = scratch / "figures.html", page = scratch / "page.html";
  const auto made = amble({"view", run, "--static", "-o", figures});
  EXPECT_EQ(made.exit_code, ok) << made.err;
  EXPECT_EQ(made.err, "");
  const auto by_page = amble({"page", run, "-o", page});
  EXPECT_EQ(by_page.exit_code, ok);
  EXPECT_EQ(by_page.err, "amble page DIR: now written amble view DIR --static\n");
  EXPECT_EQ(slurp(figures), slurp(page));
}

TEST(Gait, IsTheSameOfARunItsChampionAndARecording) {
  const TemporaryFolder scratch;
  ASSERT_EQ(amble(evolve(scratch / "run", 4, 2)).exit_code, ok);
  std::string champion;
  for (const auto& entry : std::filesystem::directory_iterator(scratch / "run/champions"))
    champion = std::max(champion, entry.path().string());
  const auto of_run = amble({"gait", scratch / "run", "--seconds", "4", "--json", "-"});
  ASSERT_EQ(of_run.exit_code, ok) << of_run.err;
  EXPECT_NE(of_run.out.find("\"format\": \"amble-gait\""), std::string::npos) << of_run.out;
  EXPECT_EQ(amble({"gait", champion, "--seconds", "4", "--json", "-"}).out, of_run.out);

  const auto table =
      amble({"gait", champion, "--undisturbed", "--seconds", "4", "--json", scratch / "gait.json"});
  EXPECT_EQ(slurp(scratch / "gait.json"), of_run.out);
  const auto trial = amble({"trial", champion, "--seconds", "4", "--record", scratch / "walk.rec"});
  ASSERT_EQ(trial.exit_code, ok) << trial.err;
  EXPECT_NE(trial.out.find("\ngait      "), std::string::npos) << trial.out;
  // A recording keeps the centre of mass in single precision; the table shows no more than that.
  EXPECT_EQ(amble({"gait", scratch / "walk.rec"}).out, table.out);
}

}  // namespace run_test
}  // namespace amble::tests
