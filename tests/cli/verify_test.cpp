#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amble/core/error.hpp"
#include "tests/cli/process.hpp"

namespace amble::tests {
namespace verify_test {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr int ok = static_cast<int>(ExitCode::ok), bad_file = static_cast<int>(ExitCode::bad_file),
              differs = static_cast<int>(ExitCode::differs);

class VerifyRun : public testing::Test {
 protected:
  VerifyRun() { make(run_, {}); }

  static void make(const fs::path& run, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{
        "evolve",        AMBLE_SOURCE_DIR "/configs/authors/supg-objective.toml",
        "--set",         "population.size=40",
        "--set",         "trial.duration_s=0.2",
        "--generations", "2",
        "--out",         run.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto made = amble(arguments);
    EXPECT_EQ(made.exit_code, ok) << made.err;
  }
  void expect_difference(const std::string& words) const {
    const auto found = amble({"verify", run_.string()});
    EXPECT_EQ(found.exit_code, differs) << found.err;
    EXPECT_THAT(found.out, HasSubstr(words));
  }

  TemporaryFolder scratch_;
  fs::path run_ = scratch_ / "run", first_ = run_ / "champions/00000.json";
};

TEST_F(VerifyRun, DoesNotTakeAChampionOfAnotherRunForItsOwn) {
  const auto first_of = [&](const std::string& name, const std::vector<std::string>& how) {
    make(scratch_ / name, how);
    fs::copy(scratch_ / name / "champions/00000.json", first_, fs::copy_options::overwrite_existing);
  };
  first_of("longer", {"--set", "trial.duration_s=0.3"});
  expect_difference("00000.json differs: its trial is not the run's");
  first_of("other", {"--seed", "2"});
  expect_difference("00000.json differs: its seed is 2, the run's 1");
  first_of("heavier", {"--set", "genome.weight_limit=7"});
  expect_difference("00000.json differs: it reached ");
}

TEST_F(VerifyRun, AgreesWhateverTheSettingsOfNoiseThatThereIsNot) {
  make(scratch_ / "quiet", {"--set", "noise.push_interval_s=3", "--set", "noise.score=worst"});
  const auto found = amble({"verify", scratch_ / "quiet"});
  EXPECT_EQ(found.exit_code, ok) << found.out;
}

TEST_F(VerifyRun, RunsChampionsAgainWithoutTheTableButDoesNotPassThen) {
  fs::remove(run_ / "generations.csv");
  const auto found = amble({"verify", run_.string()});
  EXPECT_THAT(found.out, HasSubstr("00000.json agrees"));
  EXPECT_EQ(found.exit_code, static_cast<int>(ExitCode::io));
}

TEST_F(VerifyRun, DoesNotTakeAChampionUnderAnotherName) {
  fs::copy(first_, run_ / "champions/00099.json");
  expect_difference("00099.json differs: it is of generation 0, not of that in its name");
}

TEST_F(VerifyRun, NamesTheChampionsThatAreMissing) {
  fs::remove_all(run_ / "champions");
  expect_difference("00000.json missing\n");
}

TEST_F(VerifyRun, ARunDoesNotGoOnWithoutItsBestChampion) {
  fs::path best = first_;
  for (const auto& entry : fs::directory_iterator(run_ / "champions")) best = std::max(best, entry.path());
  const auto text = slurp(best);
  const std::vector<std::string> resume{"resume", run_.string(), "--generations", "3"};
  fs::remove(best);
  const auto missing = amble(resume);
  EXPECT_EQ(missing.exit_code, bad_file);
  EXPECT_THAT(missing.err, HasSubstr(best.filename().string() + ": missing, and it is the best of the run"));
  spill(best, text.substr(0, text.size() / 2));
  EXPECT_EQ(amble(resume).exit_code, bad_file);
  make(scratch_ / "heavier", {"--set", "genome.weight_limit=7"});
  spill(best, slurp(scratch_ / "heavier/champions" / best.filename()));
  const auto foreign = amble(resume);
  EXPECT_EQ(foreign.exit_code, bad_file);
  EXPECT_THAT(foreign.err, HasSubstr(best.filename().string()));
  spill(best, text);
  EXPECT_EQ(amble(resume).exit_code, ok);
}

}  // namespace verify_test
}  // namespace amble::tests
