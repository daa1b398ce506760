#include "amble/watch/run_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "amble/io/lock.hpp"
#include "tests/watch/fake_run.hpp"

namespace amble::watch {
namespace {

using testing::HasSubstr;
using testing::Optional;

class RunSummary : public testing::Test {
 protected:
  const Summary& at(double time_s) {
    reader_.poll(LockHolders::now(), time_s);
    return reader_.summary();
  }

  test::TemporaryFolder scratch_;
  std::filesystem::path folder_ = scratch_ / "run";
  SummaryReader reader_{folder_, "run"};
};

TEST_F(RunSummary, TellsHowFarARunIsAndHowLongItTakes) {
  FakeRun run(folder_, 10);
  const io::FolderLock lock(folder_);
  for (const double best : {0.25, 0.5, 1.5}) run.grow(best);
  run.champion(2, "{}");
  const Summary& now = at(0);
  EXPECT_EQ(now.stage, Stage::running);
  EXPECT_EQ(now.name, "fake");
  EXPECT_EQ(now.seed, 7);
  EXPECT_EQ(now.unit, " m");
  EXPECT_EQ(now.generations, 10);
  EXPECT_EQ(now.done, 3);
  EXPECT_THAT(now.best, Optional(1.5));
  EXPECT_THAT(now.typical, Optional(0.5));
  EXPECT_THAT(now.left_s, Optional(14.0));
  EXPECT_THAT(now.champion, Optional(2));
}

TEST_F(RunSummary, ChangesOnlyWithTheRun) {
  FakeRun run(folder_, 10);
  const auto locks = LockHolders::now();
  EXPECT_TRUE(reader_.poll(locks, 0));
  EXPECT_FALSE(reader_.poll(locks, 1));
  run.grow(1.0);
  EXPECT_TRUE(reader_.poll(locks, 2));
  EXPECT_FALSE(reader_.poll(locks, 3));
}

TEST_F(RunSummary, OfALongTableReadsTheEnd) {
  FakeRun run(folder_, 10'000);
  for (int i = 0; i < 5000; ++i) run.grow(0.001 * i);
  EXPECT_EQ(at(0).done, 5000);
  EXPECT_THAT(at(0).best, Optional(testing::DoubleNear(4.999, 1e-9)));
}

TEST_F(RunSummary, ARunOnWhichNobodyWorksIsStopped) {
  FakeRun run(folder_, 10);
  run.grow(1.0);
  EXPECT_EQ(at(0).stage, Stage::stopped);
  auto lock = std::make_unique<io::FolderLock>(folder_);
  EXPECT_EQ(at(1).stage, Stage::running);
  lock.reset();
  EXPECT_EQ(at(2).stage, Stage::stopped);
}

TEST_F(RunSummary, ARunThatGrowsWithoutALockInSightGoesOnElsewhere) {
  FakeRun run(folder_, 10);
  run.grow(1.0);
  EXPECT_EQ(at(0).stage, Stage::stopped);
  run.grow(1.1);
  EXPECT_EQ(at(100).stage, Stage::running);
  EXPECT_EQ(at(105.9).stage, Stage::running);  // three generations of two seconds
  EXPECT_EQ(at(106.1).stage, Stage::stopped);
}

TEST_F(RunSummary, ARunEndsWithItsLastGenerationAndGoesOnWhenItIsMadeLonger) {
  FakeRun run(folder_, 2);
  const io::FolderLock lock(folder_);
  run.grow(1.0);
  EXPECT_EQ(at(0).stage, Stage::running);
  run.grow(1.1);
  EXPECT_EQ(at(1).stage, Stage::ended);
  EXPECT_FALSE(at(1).left_s);
  run.lengthen(5);
  EXPECT_EQ(at(2).stage, Stage::running);
  EXPECT_EQ(at(2).generations, 5);
}

TEST_F(RunSummary, AFolderThatVanishesIsGoneWithWhatWasKnown) {
  EXPECT_EQ(at(0).stage, Stage::waiting);
  FakeRun run(folder_, 10);
  run.grow(1.0);
  at(1);
  std::filesystem::remove_all(folder_);
  EXPECT_EQ(at(2).stage, Stage::gone);
  EXPECT_EQ(at(2).done, 1);
  FakeRun again(folder_, 20);
  EXPECT_EQ(at(3).generations, 20);
  EXPECT_EQ(at(3).done, 0);
}

TEST_F(RunSummary, AConfigThatCannotBeReadIsTold) {
  FakeRun run(folder_, 10);
  run.grow(1.0);
  std::ofstream(folder_ / "config.toml") << "generations = 'ten'\n";
  EXPECT_THAT(at(0).trouble, HasSubstr("config.toml:1: 'generations' = \"ten\": expected a whole number"));
  EXPECT_EQ(at(0).done, 1);
}

}  // namespace
}  // namespace amble::watch
