#include "amble/core/statistics.hpp"

#include <gtest/gtest.h>

namespace amble {
namespace {

TEST(Median, IsTheMiddleOneOrTheMeanOfTheTwoInTheMiddle) {
  EXPECT_EQ(median({4.0}), 4.0);
  EXPECT_EQ(median({9.0, -1.0, 2.0}), 2.0);
  EXPECT_EQ(median({8.0, 1.0, 3.0, 2.0}), 2.5);
}

TEST(MedianDeathTest, NeedsAValue) {
  EXPECT_DEATH(median({}), "a median needs a value");
}

}  // namespace
}  // namespace amble
