#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mount.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/cli/process.hpp"

namespace amble::tests {
namespace {

namespace fs = std::filesystem;

/// A study of two conditions and three seeds that takes a second or two.
const std::string study_toml = R"(name = "tiny"
seeds = [1, 2, 3]
generations = 4
settings = ["engine=batch", "population.size=30", "speciation.target_min=3", "speciation.target_max=6", "trial.duration_s=2"]
[[conditions]]
name = "supg"
config = "SOURCE/configs/authors/supg-novelty.toml"
[[conditions]]
name = "sine"
config = "SOURCE/configs/authors/sine-objective.toml"
[[tests]]
name = "longer"
seconds = 6
[[tests]]
name = "noisy"
seconds = 2
noise = "SOURCE/configs/robust/supg-objective.toml"
episodes = 2
conditions = ["supg"]
)";

std::string replaced(std::string text, const std::string& old, const std::string& now) {
  for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += now.size())
    text.replace(at, old.size(), now);
  return text;
}

class Study : public testing::Test {
 protected:
  Study() { write(study_toml); }

  void write(const std::string& text) const {
    spill(folder_ / "study.toml", replaced(text, "SOURCE", AMBLE_SOURCE_DIR));
  }
  std::vector<std::string> command(const std::string& out, std::vector<std::string> more = {}) const {
    std::vector<std::string> words{"study", (folder_ / "study.toml").string(), "--out",
                                   (folder_ / out).string()};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  Finished study(const std::string& out, std::vector<std::string> more = {}) const {
    return amble(command(out, std::move(more)));
  }
  fs::path record(const std::string& out, const std::string& name) const {
    return folder_ / out / "ledger" / (name + ".json");
  }

  const TemporaryFolder folder_;
};

/// "…digest 0123456789abcdef" of what a study printed at its end.
std::string digest(const Finished& finished) {
  const auto at = finished.out.find("digest ");
  return at == std::string::npos ? "none: " + finished.out + finished.err : finished.out.substr(at + 7, 16);
}

/// Every file of a study's folder.
std::map<std::string, std::string> all_files(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[entry.path().string()] = slurp(entry.path());
  return files;
}

TEST_F(Study, GivesTheSameLedgerForAnyNumberOfProcessesAndAnyShards) {
  const auto alone = study("alone", {"--jobs", "1"});
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  ASSERT_NE(alone.out.find("6 of 6 runs are done"), std::string::npos) << alone.out;
  for (const char* jobs : {"2", "4"}) {
    const auto many = study(std::string("jobs") + jobs, {"--jobs", jobs, "--discard-runs"});
    EXPECT_EQ(many.exit_code, 0) << many.err;
    EXPECT_EQ(digest(many), digest(alone));
    for (const auto& left : fs::directory_iterator(folder_ / (std::string("jobs") + jobs) / "runs"))
      EXPECT_EQ(left.path().filename(), ".lock");
  }
  fs::create_directories(folder_ / "merged" / "ledger");
  for (const char* shard : {"1/3", "2/3", "3/3"}) {
    EXPECT_EQ(study(std::string("part") + shard[0], {"--jobs", "1", "--shard", shard}).exit_code, 0);
    fs::copy(folder_ / (std::string("part") + shard[0]) / "ledger", folder_ / "merged" / "ledger",
             fs::copy_options::recursive);
  }
  const auto merged = study("merged", {"--status"});
  EXPECT_EQ(digest(merged), digest(alone)) << merged.out << merged.err;
  EXPECT_NE(merged.out.find("6 of 6 runs are done"), std::string::npos) << merged.out;
}

TEST_F(Study, KilledAtRandomMomentsGoesOnToTheSameLedger) {
  const auto undisturbed = study("undisturbed", {"--jobs", "2"});
  ASSERT_EQ(undisturbed.exit_code, 0) << undisturbed.err;
  std::mt19937 random(1);
  for (int kill = 0; kill < 10; ++kill) {
    Process process(command("killed", {"--jobs", "2"}));
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 800));
    process.signal(SIGKILL);
    process.wait();
  }
  const auto last = study("killed", {"--jobs", "2"});
  EXPECT_EQ(last.exit_code, 0) << last.err;
  EXPECT_EQ(digest(last), digest(undisturbed));
}

TEST_F(Study, TwoStudiesOnOneFolderShareTheWork) {
  Process first(command("shared", {"--jobs", "1"})), second(command("shared", {"--jobs", "1"}));
  const auto one = first.wait(), two = second.wait();
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_EQ(two.exit_code, 0) << two.err;
  EXPECT_EQ(digest(study("shared", {"--status"})), digest(study("alone", {"--jobs", "1"})));
}

TEST_F(Study, CountsARecordWithoutItsRunFolderAsDone) {
  ASSERT_EQ(study("s", {"--jobs", "2"}).exit_code, 0);
  fs::remove_all(folder_ / "s" / "runs");
  const auto written = fs::last_write_time(record("s", "supg-001"));
  const auto again = study("s", {"--jobs", "2"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_FALSE(fs::exists(folder_ / "s" / "runs"));
  EXPECT_EQ(fs::last_write_time(record("s", "supg-001")), written);
}

TEST_F(Study, AddsATestToFinishedRunsWithoutEvolvingThemAgain) {
  ASSERT_EQ(study("s", {"--jobs", "2"}).exit_code, 0);
  const auto before = slurp(record("s", "supg-001"));
  write(study_toml + "[[tests]]\nname = \"ode\"\nengine = \"ode\"\nseconds = 1\n");
  fs::remove_all(folder_ / "s" / "runs");
  const auto again = study("s", {"--jobs", "2"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(before.find("\"ode\""), std::string::npos);
  EXPECT_NE(slurp(record("s", "supg-001")).find("\"ode\""), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "s" / "runs"));
}

TEST_F(Study, ThatWasChangedSaysWhatNoLongerFitsAndTouchesNothing) {
  ASSERT_EQ(study("s", {"--jobs", "2"}).exit_code, 0);
  fs::remove(record("s", "supg-002"));  // its run folder is there still
  const auto before = all_files(folder_ / "s");
  for (const auto& [old, now] :
       std::map<std::string, std::string>{{"generations = 4", "generations = 5"},
                                          {"population.size=30", "population.size=31"},
                                          {"seconds = 6", "seconds = 7"}}) {
    write(replaced(study_toml, old, now));
    const auto refused = study("s", {"--jobs", "2"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(refused.err.find("runs no longer fit the study"), std::string::npos) << refused.err;
    EXPECT_EQ(std::ranges::count(refused.err, '\n'), 1) << refused.err;
  }
  EXPECT_EQ(all_files(folder_ / "s"), before);
}

TEST_F(Study, NamesARecordThatIsCutInHalf) {
  ASSERT_EQ(study("s", {"--jobs", "2"}).exit_code, 0);
  const auto text = slurp(record("s", "sine-003"));
  spill(record("s", "sine-003"), text.substr(0, text.size() / 2));
  const auto refused = study("s");
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("sine-003.json"), std::string::npos) << refused.err;
  EXPECT_EQ(std::ranges::count(refused.err, '\n'), 1) << refused.err;
}

TEST_F(Study, WithAConfigThatNoLongerParsesNamesItsLineAndLosesNothing) {
  spill(folder_ / "own.toml", "include = [\"" AMBLE_SOURCE_DIR "/configs/authors/supg-novelty.toml\"]\n");
  write(replaced(study_toml, "SOURCE/configs/authors/supg-novelty.toml", "own.toml"));
  ASSERT_EQ(study("s", {"--jobs", "2"}).exit_code, 0);
  fs::remove(record("s", "supg-002"));
  const auto before = all_files(folder_ / "s");
  spill(folder_ / "own.toml", slurp(folder_ / "own.toml") + "seed = = 1\n");
  const auto refused = study("s", {"--jobs", "2"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("own.toml:2"), std::string::npos) << refused.err;
  EXPECT_EQ(std::ranges::count(refused.err, '\n'), 1) << refused.err;
  EXPECT_EQ(all_files(folder_ / "s"), before);
}

TEST_F(Study, WithASeedTwiceIsRefusedInOneLine) {
  write(replaced(study_toml, "[1, 2, 3]", "[1, 2, 1]"));
  const auto refused = study("s");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("study.toml:2"), std::string::npos) << refused.err;
  EXPECT_EQ(std::ranges::count(refused.err, '\n'), 1) << refused.err;
  EXPECT_FALSE(fs::exists(folder_ / "s"));
}

TEST_F(Study, OnAFullDiskSaysSoAndGoesOnWhereThereIsRoom) {
  const auto alone = study("alone", {"--jobs", "1"});
  const auto disk = folder_ / "disk";
  fs::create_directories(disk);
  if (mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=300k") != 0) GTEST_SKIP() << "needs the right to mount";
  const auto full = study("disk/s", {"--jobs", "2"});
  EXPECT_EQ(full.exit_code, 4) << full.err;
  EXPECT_NE(full.err.find("No space left on device"), std::string::npos) << full.err;
  fs::copy(disk / "s", folder_ / "moved", fs::copy_options::recursive);
  umount(disk.c_str());
  const auto rest = study("moved", {"--jobs", "2"});
  EXPECT_EQ(rest.exit_code, 0) << rest.err;
  EXPECT_EQ(digest(rest), digest(alone));
}

TEST_F(Study, ARunThatFailsIsReportedAndTheOthersContinue) {
  ASSERT_EQ(study("s", {"--jobs", "1", "--shard", "1/6"}).exit_code, 0);
  // A run folder whose checkpoint is gone can neither go on nor begin anew.
  const auto folder = folder_ / "s" / "runs" / "supg-001";
  ASSERT_TRUE(fs::exists(folder / "checkpoint.bin"));
  fs::remove(record("s", "supg-001"));
  fs::remove(folder / "checkpoint.bin");
  const auto rest = study("s", {"--jobs", "2"});
  EXPECT_EQ(rest.exit_code, 4) << rest.err;
  const auto said = rest.err.find("supg, seed 1: failed");
  EXPECT_NE(said, std::string::npos) << rest.err;
  EXPECT_EQ(rest.err.find("supg, seed 1: failed", said + 1), std::string::npos)
      << "by each process: " << rest.err;
  EXPECT_NE(rest.out.find("5 of 6 runs are done"), std::string::npos) << rest.out << rest.err;
  EXPECT_NE(rest.err.find("1 run failed; the same command tries it again"), std::string::npos) << rest.err;
}

/// The processes that a process has started.
std::vector<pid_t> children_of(pid_t parent) {
  std::vector<pid_t> children;
  std::istringstream list(slurp(fmt::format("/proc/{0}/task/{0}/children", parent)));
  for (pid_t child = 0; list >> child;) children.push_back(child);
  return children;
}

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

TEST_F(Study, ReplacesNoStudyFileInItsFolderThatItHasNotWritten) {
  const auto own = slurp(folder_ / "study.toml");
  const auto beside = study(".", {"--jobs", "2"});
  EXPECT_EQ(beside.exit_code, 0) << beside.err;
  EXPECT_EQ(slurp(folder_ / "study.toml"), own);
  fs::create_directories(folder_ / "t");
  spill(folder_ / "t" / "study.toml", "other = 1\n");
  const auto refused = study("t");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(std::ranges::count(refused.err, '\n'), 1) << refused.err;
  EXPECT_EQ(slurp(folder_ / "t" / "study.toml"), "other = 1\n");
}

TEST_F(Study, PassesItsOptionsOnToSlurmsTasks) {
  write(replaced(study_toml, "name = \"tiny\"", "name = \"my study\\n#SBATCH --partition=all\""));
  const auto script = folder_ / "batch.sh";
  const auto written =
      study("s", {"--slurm", script.string(), "--jobs", "2", "--workers", "3", "--discard-runs"});
  ASSERT_EQ(written.exit_code, 0) << written.err;
  const auto text = slurp(script);
  EXPECT_NE(text.find("#SBATCH --job-name=amble-my-study--SBATCH---partition-all\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("#SBATCH --cpus-per-task=6\n"), std::string::npos) << text;
  EXPECT_NE(text.find("--jobs \"$((${SLURM_CPUS_PER_TASK:-6} / 3))\" --workers 3 --discard-runs &"),
            std::string::npos)
      << text;
  const auto refused = study("s", {"--slurm", script.string(), "--shard", "1/2"});
  EXPECT_EQ(refused.exit_code, 2) << refused.err;
}

TEST_F(Study, StoppedByASignalSaysHowToGoOn) {
  write(replaced(study_toml, "generations = 4", "generations = 4000"));
  Process process(command("s", {"--jobs", "2"}));
  while (!fs::exists(folder_ / "s" / "runs" / "supg-001" / "checkpoint.bin"))
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  process.signal(SIGTERM);
  const auto stopped = process.wait();
  EXPECT_EQ(stopped.exit_code, 7) << stopped.err;
  EXPECT_NE(stopped.err.find("go on by the same command"), std::string::npos) << stopped.err;
}

}  // namespace
}  // namespace amble::tests
