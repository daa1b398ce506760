#include "amble/gait/travel.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace amble::gait {
namespace {

TEST(Travel, PathIsMeasuredFromSecondToSecond) {
  // 3 m along x in the first two seconds (with a sway within each that does not count), then 4 m along y in
  // half a second: path 3 + 4, distance 5.
  TravelMeter travel({1.0, 1.0, 0.5}, {}, 0.5);
  travel.add({1.0, 9.0, 0.5}, {}, {});
  travel.add({2.5, 1.0, 0.7}, {}, {});
  travel.add({9.0, 9.0, 0.5}, {}, {});
  travel.add({4.0, 1.0, 0.5}, {}, {});
  EXPECT_DOUBLE_EQ(travel.path_m(), 3.0);
  travel.add({4.0, 5.0, 0.3}, {}, {});
  EXPECT_DOUBLE_EQ(travel.path_m(), 7.0);
  EXPECT_DOUBLE_EQ(travel.distance_m(), 5.0);
  EXPECT_FALSE(travel.work());
}

TEST(Travel, WorkIsTorqueTimesTheMeanOfTheSpeedsBeforeAndAfter) {
  // Joint 0 turns by 0.125, 0.25 and 0.125 rad, so at means of 0.0625, 0.1875 and 0.1875 rad per step, under
  // 2, 2 and −4 N m: 0.125 and 0.375 J given, 0.75 J taken. Joint 1 holds 5 N m and does not move.
  TravelMeter travel({}, std::vector{0.0f, 0.0f}, 0.01);
  const std::vector<std::vector<float>> angles{{0.125f, 0.0f}, {0.375f, 0.0f}, {0.5f, 0.0f}},
      torques{{2.0f, 0.0f}, {2.0f, 5.0f}, {-4.0f, 5.0f}};
  for (std::size_t k = 0; k < 3; ++k) travel.add({}, angles[k], torques[k]);
  ASSERT_TRUE(travel.work());
  EXPECT_NEAR(travel.work()->positive_j, 0.5, 1e-7);
  EXPECT_NEAR(travel.work()->absolute_j, 1.25, 1e-7);
}

TEST(Travel, NoWorkBringsARobotToWhereItBegins) {
  // It begins bent by 0.5 rad and stays so.
  TravelMeter travel({}, std::vector{0.5f}, 0.01);
  for (int k = 0; k < 3; ++k) travel.add({}, std::vector{0.5f}, std::vector{3.0f});
  EXPECT_EQ(travel.work()->absolute_j, 0.0);
}

TEST(Travel, KnowsNoWorkIfATorqueIsMissing) {
  TravelMeter travel({}, std::vector{0.0f}, 0.01);
  EXPECT_FALSE(travel.work());
  const std::vector<float> one{1.0f};
  travel.add({}, one, one);
  EXPECT_TRUE(travel.work());
  travel.add({}, one, {});
  EXPECT_FALSE(travel.work());
}

}  // namespace
}  // namespace amble::gait
