#include "amble/score/score.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "amble/core/error.hpp"

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
  EXPECT_EQ(credited(4.0, record::Outcome::fell, 0.25), 1.0);
  EXPECT_EQ(credited(0.1 + 0.2, record::Outcome::fell, 1.0), 0.1 + 0.2);
  EXPECT_EQ(credited(4.0, record::Outcome::completed, 0.25), 4.0);
}

/// 15 s in which the robot went 3 m along x and 4 m along y, leant over by 60 degrees, and spent 200 J.
record::Trajectory walk() {
  record::Trajectory trajectory;
  trajectory.steps = 1500;
  trajectory.timestep_s = 0.01;
  trajectory.com_end_m = {3.0, 4.0, 0.0};
  trajectory.energy_j = 200.0;
  trajectory.upright_steps = 750.0;
  return trajectory;
}

/// What a score of this quantity alone makes of the walk of a robot that weighs 100 N.
double of_walk(const std::string& quantity, Settings settings = {}) {
  settings.terms = {{.quantity = quantity}};
  return Score(settings, 15.0, 100.0).of(walk());
}

TEST(Score, IsTheDistanceByDefaultToTheBit) {
  EXPECT_TRUE(Settings().is_distance());
  EXPECT_EQ(Score({}, 15.0, 100.0).of(walk()), distance_m(walk()));
  EXPECT_FALSE(Score({}, 15.0, 100.0).measures().energy);
  EXPECT_EQ(with_unit("3.5", {}), "3.5 m");
}

TEST(Score, KnowsEachOfItsQuantities) {
  EXPECT_EQ(of_walk("distance"), 5.0);
  EXPECT_EQ(of_walk("forward"), 3.0);
  EXPECT_EQ(of_walk("forward", {.direction = {0.0, 2.0}}), 4.0);
  EXPECT_DOUBLE_EQ(of_walk("forward", {.direction = {3.0, 4.0}}), 5.0);
  EXPECT_DOUBLE_EQ(of_walk("speed_kept", {.speed_m_s = 0.2}), 1.0);
  EXPECT_DOUBLE_EQ(of_walk("speed_kept", {.speed_m_s = 0.4}), 0.5);
  EXPECT_EQ(of_walk("speed_kept", {.speed_m_s = 0.1}), 0.0) << "twice the speed";
  EXPECT_DOUBLE_EQ(of_walk("economy"), 100.0 * 5.0 / 200.0);
  EXPECT_EQ(of_walk("uprightness"), 0.5);
  EXPECT_EQ(of_walk("upright_time"), 1.0);
}

TEST(Score, IsASumOfWeightedTermsAndNeverNegative) {
  Settings settings;
  settings.terms = {{"distance", 2.0}, {"uprightness", 4.0}, {"forward", -1.0}};
  EXPECT_DOUBLE_EQ(Score(settings, 15.0, 100.0).of(walk()), 10.0 + 2.0 - 3.0);
  EXPECT_EQ(with_unit("3.5", settings), "3.5");
  EXPECT_TRUE(Score(settings, 15.0, 100.0).measures().uprightness);
  settings.terms = {{"forward", -1.0}};
  EXPECT_EQ(Score(settings, 15.0, 100.0).of(walk()), 0.0);
}

TEST(Score, OfATrialThatBreaksALimitIsItsShare) {
  Settings settings;
  settings.limits = {{.quantity = "uprightness", .least = 0.5}};
  EXPECT_EQ(Score(settings, 15.0, 100.0).of(walk()), 5.0) << "a limit may be reached";
  settings.limits = {{.quantity = "uprightness", .least = 0.6}};
  EXPECT_EQ(Score(settings, 15.0, 100.0).of(walk()), 0.0);
  settings.breach_factor = 0.5;
  EXPECT_EQ(Score(settings, 15.0, 100.0).of(walk()), 2.5);
  settings.limits = {{.quantity = "economy", .most = 2.0}};
  EXPECT_EQ(Score(settings, 15.0, 100.0).of(walk()), 2.5);
  EXPECT_TRUE(Score(settings, 15.0, 100.0).measures().energy) << "limits are measured, too";
}

TEST(Score, IsNothingWhereTheSimulationBrokeDown) {
  Settings settings;
  settings.terms = {{.quantity = "upright_time"}};
  auto trajectory = walk();
  trajectory.outcome = record::Outcome::diverged;
  EXPECT_EQ(Score(settings, 15.0, 100.0).of(trajectory), 0.0);
}

TEST(Score, IsFiniteForARobotThatDidNothing) {
  for (const Quantity& quantity : quantities()) {
    Settings settings;
    settings.terms = {{.quantity = std::string(quantity.name)}};
    EXPECT_TRUE(std::isfinite(Score(settings, 15.0, 100.0).of({}))) << quantity.name;
  }
}

/// The message of the error; "" if the settings are valid.
std::string error_of(const Settings& settings) {
  try {
    settings.validate();
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

TEST(ScoreSettings, AreRefusedWhereTheyNameNothingOrCannotBeKept) {
  EXPECT_EQ(error_of({}), "");
  EXPECT_EQ(error_of({.terms = {}}), "score.terms: expected at least one term");
  EXPECT_EQ(error_of({.terms = {{.quantity = "joy"}}}),
            "score.terms: quantity \"joy\": expected distance, forward, speed_kept, economy, uprightness, "
            "upright_time");
  EXPECT_THAT(error_of({.limits = {{.quantity = "joy"}}}), testing::HasSubstr("score.limits: quantity"));
  EXPECT_EQ(error_of({.limits = {{.quantity = "uprightness", .least = 0.9, .most = 0.5}}}),
            "score.limits: uprightness: least = 0.9 is above most = 0.5");
  EXPECT_EQ(error_of({.direction = {0.0, 0.0}}), "score.direction: expected two numbers, not both 0");
  EXPECT_EQ(error_of({.direction = {1.0}}), "score.direction: expected two numbers, not both 0");
}

}  // namespace
}  // namespace amble::score
