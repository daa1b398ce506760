#include "amble/analysis/summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/analysis/fixture.hpp"

namespace amble::analysis {
namespace {

using testing::ElementsAre;

TEST(Summary, CountsFromBeforeTheFirstStep) {
  const Summary summary = summarise(tests::walk(20).motion);
  EXPECT_NEAR(summary.distance_m, 1.0, 1e-12);
  EXPECT_NEAR(summary.seconds, 2.0, 1e-12);
  EXPECT_NEAR(summary.mean_speed_m_s, 0.5, 1e-12);
}

TEST(Summary, MeasuresDistanceOverTheGround) {
  Motion motion = tests::walk(1).motion;
  motion.com_m.back() = motion.com_start_m + Vec3{3, -4, 12};
  EXPECT_NEAR(summarise(motion).distance_m, 5.0, 1e-12);
}

TEST(Summary, CountsTriggersLegByLeg) {
  // Leg 0 comes down in frames 4 and 8, which gives triggers in 5 and 9; leg 3 in 1, 5 and 9, the last too
  // late.
  const Summary summary = summarise(tests::walk(10).motion);
  EXPECT_THAT(summary.triggers, ElementsAre(2, 2, 2, 2));
}

TEST(Summary, OfNoFramesIsZero) {
  const Summary summary = summarise(tests::walk(0).motion);
  EXPECT_EQ(summary.distance_m, 0.0);
  EXPECT_EQ(summary.mean_speed_m_s, 0.0);
  EXPECT_THAT(summary.triggers, ElementsAre(0, 0, 0, 0));
}

}  // namespace
}  // namespace amble::analysis
