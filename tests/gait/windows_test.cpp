#include "amble/gait/windows.hpp"

#include <gtest/gtest.h>

namespace amble::gait {
namespace {

Stretch window(std::int64_t number, Gait gait = Gait::trot) {
  Stretch stretch{.first_frame = 10 * number,
                  .sums = StrideSums(1),
                  .com_begin_m = {1.0 * static_cast<double>(number), 0, 0},
                  .com_end_m = {1.0 * static_cast<double>(number) + 1.0, 0, 0},
                  .tally = {}};
  stretch.sums.frames = 10;
  stretch.tally.add({gait, gait == Gait::irregular ? Irregular::spread_phases : Irregular::no}, 10);
  return stretch;
}

TEST(GaitWindows, StayAsTheyAreUpToTheirLimit) {
  Windows windows;
  for (std::int64_t i = 0; i < 128; ++i) windows.add(window(i));
  ASSERT_EQ(windows.list().size(), 128u);
  EXPECT_EQ(windows.list()[127].first_frame, 1270);
  EXPECT_EQ(windows.list()[127].sums.frames, 10);
}

TEST(GaitWindows, AreMergedInPairsWithoutGapsBeyondTheirLimit) {
  for (const std::int64_t count : {129, 130, 131, 255, 256, 257, 1000, 4321}) {
    Windows windows;
    for (std::int64_t i = 0; i < count; ++i) windows.add(window(i));
    ASSERT_LE(windows.list().size(), Windows::most) << count;
    ASSERT_GT(windows.list().size(), Windows::most / 2) << count;
    std::int64_t next = 0;
    for (const Stretch& stretch : windows.list()) {
      ASSERT_EQ(stretch.first_frame, next);
      ASSERT_DOUBLE_EQ(stretch.com_begin_m.x, static_cast<double>(next) / 10.0);
      next += stretch.sums.frames;
      ASSERT_DOUBLE_EQ(stretch.com_end_m.x, static_cast<double>(next) / 10.0);
      ASSERT_EQ(stretch.tally.frames(Gait::trot), stretch.sums.frames);
    }
    EXPECT_EQ(next, 10 * count);
    // All but the last are of one length.
    for (std::size_t i = 1; i + 1 < windows.list().size(); ++i)
      ASSERT_EQ(windows.list()[i].sums.frames, windows.list()[0].sums.frames) << count;
  }
}

TEST(ClassificationTally, NamesWhatHeldLongest) {
  ClassificationTally tally;
  EXPECT_FALSE(tally.longest());
  tally.add({Gait::irregular, Irregular::few_strides}, 30);
  tally.add({Gait::irregular, Irregular::mixed_pairs}, 30);
  tally.add({Gait::pace, Irregular::no}, 40);
  EXPECT_EQ(tally.longest(), (Classification{Gait::pace, Irregular::no}));
  EXPECT_EQ(tally.frames(Gait::irregular), 60);
  ClassificationTally other;
  other.add({Gait::irregular, Irregular::mixed_pairs}, 11);
  tally.merge(other);
  EXPECT_EQ(tally.longest(), (Classification{Gait::irregular, Irregular::mixed_pairs}));
}

}  // namespace
}  // namespace amble::gait
