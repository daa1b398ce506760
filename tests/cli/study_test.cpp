#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/mount.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/cli/process.hpp"
#include "tests/cli/study_fixture.hpp"

namespace amble::tests {
namespace {

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
    EXPECT_NE(
        refused.err.find("6 runs no longer fit the study: supg-001, supg-003, sine-001 to sine-003 in "),
        std::string::npos)
        << refused.err;
    EXPECT_EQ(std::ranges::count(refused.err, '\n'), 1) << refused.err;
  }
  EXPECT_EQ(all_files(folder_ / "s"), before);
}

TEST_F(Study, NamesARecordThatIsCutInHalfAndTouchesNothing) {
  ASSERT_EQ(study("s", {"--jobs", "2"}).exit_code, 0);
  const auto text = slurp(record("s", "sine-003"));
  spill(record("s", "sine-003"), text.substr(0, text.size() / 2));
  fs::remove(record("s", "supg-002"));  // work that could be begun
  const auto before = all_files(folder_ / "s");
  const auto refused = study("s", {"--jobs", "2"});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("sine-003.json"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("move it away"), std::string::npos) << refused.err;
  EXPECT_EQ(std::ranges::count(refused.err, '\n'), 1) << refused.err;
  EXPECT_EQ(all_files(folder_ / "s"), before);
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

void expect_unchanged(const std::map<std::string, std::string>& files) {
  for (const auto& [path, text] : files) EXPECT_EQ(slurp(path), text) << path;
}

/// A file system in memory, with room for so many bytes.
class SmallDisk {
 public:
  SmallDisk(fs::path folder, std::uintmax_t bytes) : folder_(std::move(folder)) {
    fs::create_directories(folder_);
    mounted_ = mount("tmpfs", folder_.c_str(), "tmpfs", 0, fmt::format("size={}", bytes).c_str()) == 0;
  }
  ~SmallDisk() {
    if (mounted_) umount(folder_.c_str());
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool mounted() const { return mounted_; }
  bool resize(std::uintmax_t bytes) const {
    const auto size = fmt::format("size={}", bytes);
    return mount("tmpfs", folder_.c_str(), "tmpfs", MS_REMOUNT, size.c_str()) == 0;
  }

 private:
  fs::path folder_;
  bool mounted_ = false;
};

/// What a folder's files take up on a disk.
std::uintmax_t disk_bytes(const fs::path& folder) {
  constexpr std::uintmax_t page = 4096;
  std::uintmax_t bytes = 0;
  for (const auto& [path, text] : all_files(folder)) bytes += (text.size() + page - 1) / page * page;
  return bytes;
}

TEST_F(Study, OnAFullDiskSaysSoKeepsWhatIsFinishedAndGoesOnWhenThereIsRoom) {
  const auto alone = study("alone", {"--jobs", "1"});
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  const auto needed = disk_bytes(folder_ / "alone");
  const SmallDisk disk(folder_ / "disk", needed / 2);
  if (!disk.mounted()) GTEST_SKIP() << "needs the right to mount";
  ASSERT_EQ(study("disk/s", {"--jobs", "1", "--shard", "1/6"}).exit_code, 0);
  const auto records = folder_ / "disk" / "s" / "ledger";
  const auto finished = all_files(records);
  ASSERT_EQ(finished.size(), 1u);
  const auto full = study("disk/s", {"--jobs", "2"});
  EXPECT_EQ(full.exit_code, 4) << full.err;
  EXPECT_NE(full.err.find("No space left on device"), std::string::npos) << full.err;
  const auto kept = all_files(records);
  EXPECT_LT(kept.size(), 6u);
  expect_unchanged(finished);
  ASSERT_TRUE(disk.resize(4 * needed));
  const auto rest = study("disk/s", {"--jobs", "2"});
  EXPECT_EQ(rest.exit_code, 0) << rest.err;
  EXPECT_EQ(digest(rest), digest(alone));
  expect_unchanged(kept);
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

TEST_F(Study, NotesCommandsThatChampionsAreNotToldOrDoNotHear) {
  write(study_toml + "[[tests]]\nname = \"told\"\nseconds = 4\ncommand = \"0.3,0,2;0.3,0.2,2;0.1,0,2\"\n" +
        "conditions = [\"supg\"]\n");
  const auto planned = study("s", {"--status"});
  EXPECT_EQ(planned.exit_code, 0);
  EXPECT_EQ(
      planned.err,
      "note: condition 'supg', test 'told': what begins after 4 s is never told, as the trial is 4 s "
      "long\nnote: condition 'supg', test 'told': its champions sense no commands, and walk as they would "
      "without\n");
}

TEST_F(Study, InAFolderWithoutANameIsRefused) {
  const auto refused = amble({"study", (folder_ / "study.toml").string(), "--out", ""});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.err,
            "amble: --out \"\": the value is empty; expected PATH; what it is for: Folder of the study; goes "
            "on with what is there\n");
}

TEST_F(Study, DoesNotGoIntoAFolderThatHoldsOtherFolders) {
  fs::create_directories(folder_ / "results" / "another");
  const auto refused = study("results");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, testing::HasSubstr("is no study's folder, and has others in it, as another"));
  EXPECT_EQ(std::ranges::count(refused.err, '\n'), 1) << refused.err;
  fs::create_directories(folder_ / "logs");
  spill(folder_ / "logs" / "log.txt", "of a shell");
  EXPECT_EQ(study("logs", {"--status"}).exit_code, 0);
  EXPECT_THAT(study("nowhere", {"--status"}).out, testing::StartsWith("there is no folder "));
}

TEST_F(Study, TakesNoMoreProcessorsForARunThanItHas) {
  const auto refused = study("s", {"--jobs", "2", "--per-run", "4"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.err, "amble: --per-run 4: more than --jobs 2, which all runs share\n");
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
      study("s", {"--slurm", script.string(), "--jobs", "6", "--per-run", "3", "--discard-runs"});
  ASSERT_EQ(written.exit_code, 0) << written.err;
  const auto text = slurp(script);
  EXPECT_NE(text.find("#SBATCH --job-name=amble-my-study--SBATCH---partition-all\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("#SBATCH --cpus-per-task=6\n"), std::string::npos) << text;
  EXPECT_NE(text.find("--jobs \"${SLURM_CPUS_PER_TASK:-6}\" --per-run 3 --discard-runs &"), std::string::npos)
      << text;
  const auto refused = study("s", {"--slurm", script.string(), "--shard", "1/2"});
  EXPECT_EQ(refused.exit_code, 2) << refused.err;
  // As these options were once called, with a word.
  const auto old =
      study("s", {"--slurm", script.string(), "--jobs", "2", "--workers", "3", "--discard-runs"});
  EXPECT_EQ(slurp(script), text);
  EXPECT_NE(old.err.find("--workers 3: now written --jobs 6 --per-run 3"), std::string::npos) << old.err;
}

}  // namespace
}  // namespace amble::tests
