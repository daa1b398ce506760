#include "amble/study/fit.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "amble/experiment/run.hpp"
#include "tests/study/fixture.hpp"

namespace amble::study {
namespace {

using testing::HasSubstr;

class Fit : public testing::Test {
 protected:
  Fit() { study_.tests = {trial_test("brief", 1.0)}; }

  std::vector<RunStatus> states(const ledger::StudySpec& study) const {
    return survey(make_plan(study, folder_.path()));
  }
  /// What survey() refuses the folder with.
  std::string refusal(const ledger::StudySpec& study) const {
    try {
      states(study);
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_input);
      return error.what();
    }
    return "";
  }
  void finish_all() {
    Notes notes;
    work_on(study_, folder_.path(), notes, true);
  }
  void begin() {
    const Plan plan = make_plan(study_, folder_.path());
    std::filesystem::create_directories(plan.paths.runs);
    experiment::Run::start(plan.folder(plan.runs[0]), plan.config(plan.runs[0]), 1);
  }

  const test::TemporaryFolder folder_;
  ledger::StudySpec study_ = small_study();
};

using States = std::vector<RunStatus>;

TEST_F(Fit, IsFoundWhileAnotherProcessFinishesRunsAndRemovesTheirFolders) {
  study_.seeds.clear();
  for (int seed = 1; seed <= 12; ++seed) study_.seeds.push_back(seed);
  study_.generations = 1;
  std::atomic<bool> finished{false};
  std::thread other([&] {
    finish_all();
    finished = true;
  });
  while (!finished) EXPECT_NO_THROW(states(study_));
  other.join();
  EXPECT_EQ(states(study_), States(12, RunStatus::done));
}

TEST_F(Fit, RunsAreMissingBegunUntestedOrDone) {
  study_.seeds = {3, 4};
  EXPECT_EQ(states(study_), (States{RunStatus::missing, RunStatus::missing}));
  begin();
  EXPECT_EQ(states(study_), (States{RunStatus::begun, RunStatus::missing}));
  finish_all();
  EXPECT_EQ(states(study_), (States{RunStatus::done, RunStatus::done}));
  study_.tests.push_back(trial_test("another", 1.0));
  study_.tests.back().conditions = {"sine"};
  EXPECT_EQ(states(study_), (States{RunStatus::untested, RunStatus::untested}));
  study_.seeds = {4, 5};
  EXPECT_EQ(states(study_), (States{RunStatus::untested, RunStatus::missing}));
}

/// All that makes a finished or begun run another one.
void expect_refusals(const std::function<std::string(const ledger::StudySpec&)>& refusal,
                     const ledger::StudySpec& study) {
  EXPECT_EQ(refusal(study), "");
  for (const int generations : {4, 6}) {
    auto changed = study;
    changed.generations = generations;
    EXPECT_THAT(refusal(changed), HasSubstr("(5 generations instead of " + std::to_string(generations)));
  }
  auto changed = study;
  changed.settings.push_back("mutation.add_node_share=0.02");
  EXPECT_THAT(refusal(changed), HasSubstr("made with other settings or another robot"));
}

TEST_F(Fit, ARecordOfAnotherStudyIsRefused) {
  finish_all();
  expect_refusals([this](const auto& study) { return refusal(study); }, study_);
  auto changed = study_;
  changed.tests[0].seconds = 2.0;
  EXPECT_THAT(refusal(changed), HasSubstr("(the test 'brief' was another one)"));
}

TEST_F(Fit, ABegunRunOfAnotherStudyIsRefused) {
  begin();
  expect_refusals([this](const auto& study) { return refusal(study); }, study_);
  const ledger::StudyPaths paths(folder_.path());
  std::filesystem::rename(paths.run("sine", 3), paths.run("sine", 4));
  study_.seeds = {4};
  EXPECT_THAT(refusal(study_), HasSubstr("sine-004 in " + paths.runs.string() + " (has the seed 3)"));
}

TEST_F(Fit, ARefusalNamesAllRunsThatDoNotFitAndWhy) {
  study_.conditions.push_back(condition("wave", "authors/sine-objective"));
  study_.seeds = {5, 9, 3, 4, 8};
  finish_all();
  study_.seeds = {11};
  begin();
  study_.seeds = {5, 9, 3, 4, 8, 11};
  study_.generations = 6;
  study_.conditions[1].settings = {"mutation.add_node_share=0.02"};
  const ledger::StudyPaths paths(folder_.path());
  EXPECT_EQ(
      refusal(study_),
      fmt::format(
          "11 of 12 runs no longer fit the study: "
          "sine-003 to sine-005, sine-008, sine-009 in {0} (5 generations instead of 6); "
          "wave-003 to wave-005, wave-008, wave-009 in {0} (made with other settings or another robot); "
          "sine-011 in {1} (5 generations instead of 6); "
          "nothing was changed; name another --out, or move them away",
          paths.records.string(), paths.runs.string()));
}

}  // namespace
}  // namespace amble::study
