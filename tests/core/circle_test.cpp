#include "amble/core/circle.hpp"

#include <gtest/gtest.h>

namespace amble {
namespace {

TEST(Circle, TakesTheNearestOfEqualValuesAndKeepsThemInItsRange) {
  constexpr Circle degrees{.lowest = -180.0, .turn = 360.0}, turns{.lowest = 0.0, .turn = 1.0};
  EXPECT_EQ(degrees.nearest(-170.0, 170.0), 190.0);
  EXPECT_EQ(degrees.nearest(170.0, -170.0), -190.0);
  EXPECT_EQ(degrees.nearest(10.0, 20.0), 10.0);
  EXPECT_EQ(turns.nearest(0.125, 0.875), 1.125);
  EXPECT_EQ(degrees.inside(190.0), -170.0);
  EXPECT_EQ(degrees.inside(-190.0), 170.0);
  EXPECT_EQ(degrees.inside(180.0), 180.0);
  EXPECT_EQ(turns.inside(-0.25), 0.75);
}

TEST(Circle, ThatIsALineLeavesAllAsItIs) {
  EXPECT_EQ(Circle{}.nearest(-170.0, 170.0), -170.0);
  EXPECT_EQ(Circle{}.inside(1e9), 1e9);
}

}  // namespace
}  // namespace amble
