#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amble/core/error.hpp"
#include "tests/cli/process.hpp"

namespace amble::tests {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr int ok = static_cast<int>(ExitCode::ok), bad_file = static_cast<int>(ExitCode::bad_file),
              differs = static_cast<int>(ExitCode::differs);

class VerifyRun : public testing::Test {
 protected:
  VerifyRun() { make(run_, "0.2", "1"); }

  static void make(const fs::path& run, const std::string& duration_s, const std::string& seed) {
    const auto made = amble({"evolve", AMBLE_SOURCE_DIR "/configs/authors/supg-objective.toml", "--set",
                             "population.size=40", "--set", "trial.duration_s=" + duration_s, "--seed", seed,
                             "--generations", "2", "--out", run.string()});
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
  make(scratch_ / "longer", "0.3", "1");
  make(scratch_ / "other", "0.2", "2");
  fs::copy(scratch_ / "longer/champions/00000.json", first_, fs::copy_options::overwrite_existing);
  expect_difference("00000.json differs: its trial is not the run's");
  fs::copy(scratch_ / "other/champions/00000.json", first_, fs::copy_options::overwrite_existing);
  expect_difference("00000.json differs: its seed is 2, the run's 1");
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
  spill(best, text);
  EXPECT_EQ(amble(resume).exit_code, ok);
}

}  // namespace
}  // namespace amble::tests
