#include "amble/gait/strides.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "amble/core/random.hpp"

namespace amble::gait {
namespace {

/// Rows of '0' and '1', one per leg, all of one length.
StrideSums watch(const std::vector<std::string>& legs, std::int64_t longest_stride = 1000) {
  StrideTracker tracker(legs.size(), longest_stride);
  StrideSums sums(legs.size());
  for (std::size_t k = 0; k < legs[0].size(); ++k) {
    std::vector<bool> touch;
    for (const auto& leg : legs) touch.push_back(leg[k] == '1');
    tracker.add(touch, sums);
  }
  return sums;
}

TEST(Strides, GoFromTouchDownToTouchDown) {
  // Lands in frames 3, 9 and 17. Strides of 6 and 8 frames with 2 and 5 frames of stance.
  const LegSums leg = watch({"11"
                             "0"
                             "110000"
                             "11111000"
                             "1"})
                          .legs[0];
  EXPECT_EQ(leg.touchdowns, 3);
  EXPECT_EQ(leg.strides, 2);
  EXPECT_EQ(leg.stride_frames, 14);
  EXPECT_EQ(leg.squared_stride_frames, 36.0 + 64.0);
  EXPECT_EQ(leg.stance_frames, 7);
  EXPECT_EQ(leg.contact_frames, 10);
}

TEST(Strides, AreAtMostAsLongAsTheLongest) {
  // Touch-downs in frames 1 and 1 + length, each of one frame.
  for (std::size_t longest = 2; longest <= 30; ++longest) {
    for (std::size_t length = 2; length <= 35; ++length) {
      const std::string leg = "01" + std::string(length - 1, '0') + "1";
      const StrideSums sums = watch({leg}, static_cast<std::int64_t>(longest));
      EXPECT_EQ(sums.legs[0].touchdowns, 2);
      EXPECT_EQ(sums.legs[0].strides, length <= longest ? 1 : 0) << length << " of at most " << longest;
      EXPECT_EQ(sums.legs[0].stride_frames, length <= longest ? static_cast<std::int64_t>(length) : 0);
      EXPECT_EQ(sums.phases[0][0].count(), length <= longest ? 1 : 0);
    }
  }
}

TEST(Strides, AFootThatStandsFromTheBeginningHasNotLanded) {
  EXPECT_EQ(watch({"1111110"}).legs[0].touchdowns, 0);
  EXPECT_EQ(watch({"0000000"}).legs[0].touchdowns, 0);
}

TEST(Strides, PhasesAreSharesOfTheOtherFootsStride) {
  // Leg 0 lands in 1, 11 and 21; leg 1 in 4 and 16: phases 0.3 and 0.5.
  const StrideSums sums =
      watch({"0111000000"
             "0111000000"
             "01",
             "0000110000"
             "0000001110"
             "00"});
  const CircularSum& phases = sums.phases[0][1];
  EXPECT_EQ(phases.count(), 2);
  EXPECT_NEAR(phases.mean(), 0.4, 1e-12);
  // Leg 1's one stride from 4 to 16 holds leg 0's touch-down in 11, at 7/12.
  EXPECT_EQ(sums.phases[1][0].count(), 1);
  EXPECT_NEAR(sums.phases[1][0].mean(), 7.0 / 12.0, 1e-12);
}

TEST(Strides, FeetThatLandTogetherHavePhaseZeroOncePerStride) {
  const StrideSums sums = watch({"01100110011001", "01000100010001"});
  EXPECT_EQ(sums.legs[0].strides, 3);
  EXPECT_EQ(sums.phases[0][1].count(), 3);
  EXPECT_NEAR(sums.phases[0][1].mean(), 0.0, 1e-12);
  EXPECT_EQ(sums.phases[1][0].count(), 3);
}

TEST(Strides, ALongRestIsNoStride) {
  const std::string legs = "01001001" + std::string(20, '1') + "001001";
  EXPECT_EQ(watch({legs}, 100).legs[0].strides, 4);
  EXPECT_EQ(watch({legs}, 10).legs[0].strides, 3);
}

TEST(Strides, AFootThatFluttersDuringOneStrideIsInNoStepWithIt) {
  std::string slow = "01" + std::string(99, '0') + "1", flutter;
  for (int k = 0; k < 51; ++k) flutter += "01";
  const StrideSums sums = watch({slow, flutter});
  EXPECT_EQ(sums.legs[0].strides, 1);
  EXPECT_EQ(sums.phases[0][1].count(), 0);
  EXPECT_EQ(sums.legs[1].strides, 50);
}

TEST(Strides, OfTwoStretchesMergeToThoseOfTheWhole) {
  for (std::uint32_t i = 0; i < 100; ++i) {
    Stream stream(1, Purpose::test, i);
    std::vector<std::string> legs(3);
    for (std::string& leg : legs)
      for (int k = 0; k < 60; ++k) leg += stream.chance(0.4) ? '1' : '0';
    const StrideSums whole = watch(legs);
    StrideTracker tracker(legs.size(), 1000);
    StrideSums first(legs.size()), second(legs.size());
    const std::size_t end = stream.below(60);
    for (std::size_t k = 0; k < legs[0].size(); ++k)
      tracker.add({legs[0][k] == '1', legs[1][k] == '1', legs[2][k] == '1'}, k < end ? first : second);
    first.merge(second);
    EXPECT_EQ(first.frames, whole.frames);
    for (std::size_t l = 0; l < legs.size(); ++l) {
      EXPECT_EQ(first.legs[l].touchdowns, whole.legs[l].touchdowns);
      EXPECT_EQ(first.legs[l].strides, whole.legs[l].strides);
      EXPECT_EQ(first.legs[l].stride_frames, whole.legs[l].stride_frames);
      EXPECT_EQ(first.legs[l].squared_stride_frames, whole.legs[l].squared_stride_frames);
      EXPECT_EQ(first.legs[l].stance_frames, whole.legs[l].stance_frames);
      EXPECT_EQ(first.legs[l].contact_frames, whole.legs[l].contact_frames);
      for (std::size_t other = 0; other < legs.size(); ++other) {
        const CircularSum &merged = first.phases[l][other], &all = whole.phases[l][other];
        EXPECT_EQ(merged.count(), all.count());
        EXPECT_NEAR(merged.resultant(), all.resultant(), 1e-12);
        if (all.resultant() > 1e-6) {
          EXPECT_NEAR(std::remainder(merged.mean() - all.mean(), 1.0), 0.0, 1e-9);
        }
      }
    }
  }
}

}  // namespace
}  // namespace amble::gait
