#include "amble/gait/circular.hpp"

#include <gtest/gtest.h>

namespace amble::gait {
namespace {

TEST(Circular, DistanceGoesTheShorterWayRound) {
  EXPECT_NEAR(phase_distance(0.9, 0.1), 0.2, 1e-15);
  EXPECT_NEAR(phase_distance(0.1, 0.9), 0.2, 1e-15);
  EXPECT_DOUBLE_EQ(phase_distance(0.25, 0.75), 0.5);
  EXPECT_DOUBLE_EQ(wrapped(-0.5), 0.5);
  EXPECT_DOUBLE_EQ(wrapped(1.25), 0.25);
}

TEST(CircularSum, OfEqualPhasesHasResultantOne) {
  CircularSum sum;
  for (int i = 0; i < 5; ++i) sum.add(0.3);
  EXPECT_NEAR(sum.mean(), 0.3, 1e-12);
  EXPECT_NEAR(sum.resultant(), 1.0, 1e-12);
}

TEST(CircularSum, MeansAcrossTheSeam) {
  // 0.95 and 0.15 are 0.2 apart: their mean is 0.05, and each leans 0.1 turns from it: R = cos(36°).
  CircularSum sum;
  sum.add(0.95);
  sum.add(0.15);
  EXPECT_NEAR(sum.mean(), 0.05, 1e-12);
  EXPECT_NEAR(sum.resultant(), 0.80901699437494742, 1e-12);
}

TEST(CircularSum, IsZeroAllRoundTheCircleAndWithoutPhases) {
  CircularSum sum;
  EXPECT_EQ(sum.resultant(), 0.0);
  for (int i = 0; i < 8; ++i) sum.add(i / 8.0);
  EXPECT_NEAR(sum.resultant(), 0.0, 1e-12);
}

TEST(CircularSum, MergesToTheSumOfAll) {
  CircularSum all, first, second;
  for (int i = 0; i < 10; ++i) {
    all.add(0.07 * i);
    (i < 4 ? first : second).add(0.07 * i);
  }
  first.merge(second);
  EXPECT_EQ(first.count(), 10);
  EXPECT_NEAR(first.mean(), all.mean(), 1e-12);
  EXPECT_NEAR(first.resultant(), all.resultant(), 1e-12);
}

TEST(PhaseDrift, FollowsAPhaseRoundTheCircle) {
  // 0.3 turns more every 10 s: five steps make 1.5 turns, 0.03 per second.
  PhaseDrift drift;
  for (int i = 0; i < 6; ++i) drift.add(10.0 * i, std::fmod(0.8 + 0.3 * i, 1.0));
  EXPECT_NEAR(drift.turns(), 1.5, 1e-12);
  EXPECT_NEAR(drift.turns_per_s(), 0.03, 1e-12);
}

TEST(PhaseDrift, FitsALineByLeastSquares) {
  // Drifts 0, 0.1, 0.1, 0.2 at 0, 1, 2, 3 s: slope = Σ(t − 1.5)(d − 0.1) / Σ(t − 1.5)² = 0.3 / 5.
  PhaseDrift drift;
  const double phases[] = {0.5, 0.6, 0.6, 0.7};
  for (int i = 0; i < 4; ++i) drift.add(i, phases[i]);
  EXPECT_NEAR(drift.turns_per_s(), 0.06, 1e-12);
}

}  // namespace
}  // namespace amble::gait
