#include "amble/study/time_left.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <optional>

#include "tests/study/fixture.hpp"

namespace amble::study {
namespace {

using testing::Optional;

/// Two conditions, two seeds, ten generations: runs 0 and 3 are of one condition, 1 and 2 of the other.
class StudyTimeLeft : public testing::Test {
 protected:
  static Plan plan_in(const std::filesystem::path& folder) {
    auto study = small_study();
    study.generations = 10;
    study.seeds = {1, 2};
    study.conditions.push_back(condition("wave", "authors/sine-objective"));
    return make_plan(study, folder);
  }
  TimeLeft time_left(int processes) const { return {plan_, {10, 10, 10, 10}, processes}; }

  const test::TemporaryFolder folder_;
  const Plan plan_ = plan_in(folder_.path());
};

TEST_F(StudyTimeLeft, IsUnknownUntilARunHasAPace) {
  auto left = time_left(1);
  EXPECT_EQ(left.seconds(), std::nullopt);
  left.begin(0, 0, 100.0);
  EXPECT_EQ(left.seconds(), std::nullopt);
  left.advance(0, 1, 103.0);
  EXPECT_THAT(left.seconds(), Optional(39 * 3.0));
}

TEST_F(StudyTimeLeft, TakesEachConditionAtItsOwnPace) {
  ASSERT_EQ(plan_.runs[0].condition, plan_.runs[3].condition);
  auto left = time_left(1);
  left.begin(0, 0, 0.0);
  left.begin(1, 0, 0.0);
  left.advance(0, 5, 5.0);
  left.advance(1, 2, 8.0);
  EXPECT_THAT(left.seconds(), Optional((5 + 10) * 1.0 + (8 + 10) * 4.0));
  left.advance(0, 6, 12.0);
  EXPECT_THAT(left.seconds(), Optional((4 + 10) * 2.0 + (8 + 10) * 4.0));
}

TEST_F(StudyTimeLeft, IsSharedByTheProcessesButNoLessThanThatOfOneRun) {
  for (const auto& [processes, seconds] : std::map<int, double>{{1, 38.0}, {2, 19.0}, {4, 10.0}, {9, 10.0}}) {
    auto left = time_left(processes);
    left.begin(0, 0, 0.0);
    left.advance(0, 2, 2.0);
    EXPECT_THAT(left.seconds(), Optional(seconds)) << processes;
  }
}

TEST_F(StudyTimeLeft, CountsNeitherWhatWasDoneBeforeNorTheTimeBetweenTwoProcesses) {
  auto left = time_left(1);
  left.begin(0, 6, 0.0);
  left.advance(0, 7, 2.0);
  EXPECT_THAT(left.seconds(), Optional((3 + 30) * 2.0));
  left.begin(0, 7, 1000.0);
  left.advance(0, 9, 1004.0);
  EXPECT_THAT(left.seconds(), Optional((1 + 30) * 2.0));
}

TEST_F(StudyTimeLeft, LeavesOutRunsThatHaveEndedAndIsUnknownWhenOnlyTestsAreLeft) {
  TimeLeft left(plan_, {10, 10, 0, 0}, 1);
  left.begin(0, 0, 0.0);
  left.advance(0, 4, 4.0);
  EXPECT_THAT(left.seconds(), Optional(6.0 + 10.0));
  left.end(0);
  EXPECT_THAT(left.seconds(), Optional(10.0));
  left.begin(1, 0, 50.0);
  left.advance(1, 10, 60.0);
  EXPECT_EQ(left.seconds(), std::nullopt);
  EXPECT_EQ(left.running(), (std::map<std::size_t, int>{{1, 10}}));
  left.end(1);
  EXPECT_TRUE(left.running().empty());
}

}  // namespace
}  // namespace amble::study
