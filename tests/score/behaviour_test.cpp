#include "amble/score/behaviour.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

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

/// The behaviour in a trial of so many steps, each of which is sampled.
PathBehaviour of_steps(int steps) {
  return PathBehaviour({.steps = steps, .path = {.stride = 1}});
}

TEST(PathBehaviour, IsThePathAsItWasSampled) {
  EXPECT_THAT(of_steps(1).of(std::vector{short_walk()}), ElementsAre(0.25f, -0.25f));
}

TEST(PathBehaviour, OfATrialThatEndedEarlyIsPaddedWithItsLastPlace) {
  EXPECT_THAT(of_steps(3).of(std::vector{short_walk()}),
              ElementsAre(0.25f, -0.25f, 0.75f, -0.5f, 0.75f, -0.5f));
}

TEST(PathBehaviour, OfARobotThatFellBeforeTheFirstSampleIsItsLastPlace) {
  auto trajectory = short_walk();
  trajectory.com_path_m.clear();
  EXPECT_THAT(of_steps(1).of(std::vector{trajectory}), ElementsAre(0.75f, -0.5f));
}

TEST(PathBehaviour, HasTwoNumbersPerSampleOfAFullTrial) {
  const auto length = [](int steps, const record::PathSampling& path) {
    return PathBehaviour({.steps = steps, .path = path}).length();
  };
  EXPECT_EQ(length(1500, {.stride = 2}), 1500u);
  EXPECT_EQ(length(1500, {.stride = 1}), 3000u);
  EXPECT_EQ(length(1500, {.stride = 7}), 2u * 214u);
  EXPECT_EQ(length(3, {.stride = 4}), 0u);
  EXPECT_EQ(length(1500, {}), 0u);
}

TEST(PathBehaviourDeathTest, IsNeverCutShort) {
  EXPECT_DEATH(of_steps(0).of(std::vector{short_walk()}), "no longer than trials");
}

TEST(DescriptorBehaviour, IsTheMeanOfEachQuantityOverEpisodes) {
  BehaviourSettings settings{.descriptors = {{"forward", ""}, {"duty_factor", "R"}, {"duty_factor", ""}}};
  settings.leg_names = {"L", "R"};
  const DescriptorBehaviour behaviour(settings);
  EXPECT_EQ(behaviour.length(), 3u);
  EXPECT_TRUE(behaviour.measures().contacts);
  EXPECT_FALSE(behaviour.measures().energy);
  record::Trajectory near = short_walk(), far = short_walk();
  near.steps = far.steps = 100;
  near.contact_steps = {0, 50};
  far.contact_steps = {100, 100};
  far.com_end_m.x += 1.0;
  EXPECT_THAT(behaviour.of(std::vector{near, far}), ElementsAre(1.25f, 0.75f, 0.625f));
}

TEST(DescriptorBehaviour, OfAnAngleIsTheMeanTheShortWayRound) {
  const DescriptorBehaviour behaviour({.descriptors = {{"turn", ""}}});
  const auto turned = [](double degrees) {
    record::Trajectory trajectory = short_walk();
    trajectory.forward_x = 1.0;
    trajectory.forward_y = 0.0;
    trajectory.forward_end_x = std::cos(degrees * M_PI / 180.0);
    trajectory.forward_end_y = std::sin(degrees * M_PI / 180.0);
    return trajectory;
  };
  EXPECT_NEAR(std::abs(behaviour.of(std::vector{turned(170.0), turned(-160.0)})[0] - 185.0f + 360.0f), 0.0,
              1e-3);
  EXPECT_NEAR(behaviour.of(std::vector{turned(-20.0), turned(50.0)})[0], 15.0, 1e-3);
}

TEST(Behaviour, IsMadeByItsNameAndHasNoNumbersWithoutOne) {
  const BehaviourSettings settings{.steps = 10, .path = {.stride = 2}};
  EXPECT_EQ(make_behaviour("path", settings)->length(), 10u);
  EXPECT_EQ(make_behaviour("path", settings)->path().stride, 2);
  EXPECT_EQ(make_behaviour("", settings)->path().stride, 0) << "nothing is recorded for it";
  EXPECT_TRUE(make_behaviour("", settings)->of(std::vector{short_walk()}).empty());
}

}  // namespace
}  // namespace amble::score
