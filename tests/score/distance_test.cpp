#include "amble/score/distance.hpp"

#include <gtest/gtest.h>

namespace amble::score {
namespace {

TEST(Distance, CountsTheHorizontalShiftInAnyDirectionAndNoHeight) {
  record::Trajectory trajectory;
  trajectory.com_start_m = {1.0, 2.0, 0.8};
  trajectory.com_end_m = {-2.0, -2.0, 0.3};
  EXPECT_DOUBLE_EQ(distance_m(trajectory), 5.0);
}

TEST(Distance, IsNothingWhereTheSimulationBrokeDown) {
  record::Trajectory trajectory;
  trajectory.com_end_m = {60.0, 0.0, 0.3};
  trajectory.outcome = record::Outcome::diverged;
  EXPECT_EQ(distance_m(trajectory), 0.0);
  trajectory.outcome = record::Outcome::fell;
  EXPECT_EQ(distance_m(trajectory), 60.0);
}

TEST(Distance, CountsForItsShareOnlyIfTheRobotFell) {
  EXPECT_EQ(credited_m(4.0, record::Outcome::fell, 0.25), 1.0);
  EXPECT_EQ(credited_m(0.1 + 0.2, record::Outcome::fell, 1.0), 0.1 + 0.2);
  EXPECT_EQ(credited_m(4.0, record::Outcome::completed, 0.25), 4.0);
}

}  // namespace
}  // namespace amble::score
