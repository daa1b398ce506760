#include "amble/motion/footfalls.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace amble::motion {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Frame k is the state at (k + 1) × 0.5 s.
TEST(Stances, RunFromTheFirstTouchingFrameToTheFirstThatDoesNot) {
  EXPECT_THAT(stances({false, true, true, false, true, false}, 0.5),
              ElementsAre(Stance{1.0, 2.0}, Stance{2.5, 3.0}));
}

TEST(Stances, BeginAtZeroIfTheFirstFrameTouchesAndEndWithTheRecording) {
  EXPECT_THAT(stances({true, false, true}, 0.5), ElementsAre(Stance{0.0, 1.0}, Stance{1.5, 1.5}));
  EXPECT_THAT(stances({true, true, true}, 0.5), ElementsAre(Stance{0.0, 1.5}));
}

TEST(Stances, AreNoneForAFootThatNeverTouches) {
  EXPECT_THAT(stances({false, false}, 0.5), IsEmpty());
  EXPECT_THAT(stances({}, 0.5), IsEmpty());
}

TEST(ContactShare, IsTheShareOfTouchingFrames) {
  EXPECT_EQ(contact_share({true, false, false, true}), 0.5);
  EXPECT_EQ(contact_share({false, false}), 0.0);
  EXPECT_EQ(contact_share({}), 0.0);
}

TEST(Touchdowns, AreRisingEdges) {
  EXPECT_THAT(touchdown_frames({true, true, false, true, true, false, true}), ElementsAre(3, 6));
}

TEST(TriggerTimes, AreTheBeginningsOfTheirSteps) {
  EXPECT_THAT(trigger_times_s({false, false, true, false, true}, 0.5), ElementsAre(1.0, 2.0));
}

TEST(TriggerTimes, CoincideWithTheTouchdownThatCausedThem) {
  const std::vector<bool> touch{true, false, true, true}, trigger{false, false, false, true};
  EXPECT_THAT(trigger_times_s(trigger, 0.5), ElementsAre(stances(touch, 0.5)[1].start_s));
}

TEST(TriggerTimes, KeepTheFirstOfARow) {
  EXPECT_THAT(trigger_times_s({false, true, true, true, false, true}, 1.0), ElementsAre(1.0, 5.0));
}

TEST(TimerAtTriggers, IsWhatItHadReachedOrNothingIfItHadStopped) {
  EXPECT_THAT(timer_at_triggers({true, false, true, false, false, true}, {1, 2, 1, 2, -1, 1}),
              ElementsAre(std::optional<double>(2.0), std::nullopt));
  EXPECT_THAT(timer_at_triggers({true, true}, {0, 1}), ElementsAre(std::optional<double>(0.0)))
      << "0 is a tick of the timer as others are";
}

}  // namespace
}  // namespace amble::motion
