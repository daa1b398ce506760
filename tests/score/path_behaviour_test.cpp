#include "amble/score/path_behaviour.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace amble::score {
namespace {

using testing::ElementsAre;

record::Trajectory short_walk() {
  record::Trajectory trajectory;
  trajectory.outcome = record::Outcome::fell;
  trajectory.com_start_m = {1.0, 1.0, 0.8};
  trajectory.com_end_m = {1.75, 0.5, 0.2};
  trajectory.com_path_m = {0.25f, -0.25f};
  return trajectory;
}

TEST(PathBehaviour, IsThePathAsItWasSampled) {
  EXPECT_THAT(path_behaviour(short_walk(), 2), ElementsAre(0.25f, -0.25f));
}

TEST(PathBehaviour, OfATrialThatEndedEarlyIsPaddedWithItsLastPlace) {
  EXPECT_THAT(path_behaviour(short_walk(), 6), ElementsAre(0.25f, -0.25f, 0.75f, -0.5f, 0.75f, -0.5f));
}

TEST(PathBehaviour, OfARobotThatFellBeforeTheFirstSampleIsItsLastPlace) {
  auto trajectory = short_walk();
  trajectory.com_path_m.clear();
  EXPECT_THAT(path_behaviour(trajectory, 2), ElementsAre(0.75f, -0.5f));
}

TEST(PathBehaviour, HasTwoNumbersPerSampleOfAFullTrial) {
  EXPECT_EQ(path_behaviour_length(1500, {.stride = 2}), 1500u);
  EXPECT_EQ(path_behaviour_length(1500, {.stride = 1}), 3000u);
  EXPECT_EQ(path_behaviour_length(1500, {.stride = 7}), 2u * 214u);
  EXPECT_EQ(path_behaviour_length(3, {.stride = 4}), 0u);
  EXPECT_EQ(path_behaviour_length(1500, {}), 0u);
}

TEST(PathBehaviourDeathTest, IsNeverCutShort) {
  EXPECT_DEATH(path_behaviour(short_walk(), 0), "no longer than trials");
}

}  // namespace
}  // namespace amble::score
