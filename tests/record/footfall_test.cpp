#include "amble/record/footfall.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace amble::record {
namespace {

TEST(Footfall, IsATouchAfterEnoughFramesOff) {
  EXPECT_TRUE(has_come_down(10, 4, 5.0));
  EXPECT_FALSE(has_come_down(9, 4, 5.0)) << "four frames off";
  EXPECT_TRUE(has_come_down(9, 4, 4.0 - 1e-6)) << "footfall_off_s / timestep_s, a rounding error short";
}

TEST(Footfall, NeedsAtLeastOneFrameOff) {
  EXPECT_FALSE(has_come_down(5, 4, 0.0));
  EXPECT_FALSE(has_come_down(5, 4, 0.5)) << "timesteps longer than footfall_off_s";
  EXPECT_TRUE(has_come_down(6, 4, 0.5));
}

TEST(Footfall, IsTheFirstTouchOfAFootThatNeverTouched) {
  EXPECT_TRUE(has_come_down(1, std::numeric_limits<int>::min() / 2, 5.0));
  EXPECT_TRUE(has_come_down(1'000'000'000, std::numeric_limits<int>::min() / 2, 5.0));
}

}  // namespace
}  // namespace amble::record
