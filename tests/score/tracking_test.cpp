#include "amble/score/tracking.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace amble::score {
namespace {

/// A robot that moves and turns steadily for some seconds, told to do something else.
struct Drive {
  double speed_m_s, turn_rad_s, told_m_s, told_rad_s;
  int seconds;
};

record::Trajectory drive(const std::vector<Drive>& drives) {
  record::Trajectory trajectory;
  trajectory.timestep_s = 0.01;
  double x = 0.0, y = 0.0, heading = 0.0;
  for (const auto& [speed, turn, told, told_turn, seconds] : drives)
    for (int k = 0; k < seconds; ++k) {
      for (int step = 0; step < 10000; ++step) {
        x += 1e-4 * speed * std::cos(heading);
        y += 1e-4 * speed * std::sin(heading);
        heading += 1e-4 * turn;
      }
      trajectory.com_by_second_m.insert(trajectory.com_by_second_m.end(), {x, y});
      trajectory.turned_by_second_rad.push_back(heading);
      trajectory.command_by_second.insert(trajectory.command_by_second.end(), {told, told_turn});
      trajectory.steps += 100;
    }
  trajectory.turned_rad = heading;
  return trajectory;
}

const Settings settings;
Context context(double seconds) {
  return {.settings = settings, .duration_s = seconds};
}

TEST(Tracking, IsAllOfARobotThatDoesWhatItIsTold) {
  const auto obedient = drive({{0.4, 0.0, 0.4, 0.0, 3}, {0.4, 0.5, 0.4, 0.5, 20}, {0.0, 0.0, 0.0, 0.0, 3}});
  // The chord of an arc is shorter than the arc, here by 1 %.
  EXPECT_NEAR(speed_error(obedient, context(26)), 0.0, 0.005);
  EXPECT_NEAR(turn_error(obedient, context(26)), 0.0, 1e-9);
  EXPECT_NEAR(heading_error(obedient, context(26)), 0.0, 1e-9);
  EXPECT_GT(tracking(obedient, context(26)), 0.98);
  EXPECT_NEAR(yaw_rate(obedient, context(26)), 10.0 / 26.0, 1e-9);
}

TEST(OwnSpeed, IsThatAlongItsOwnForwardAxisHoweverItTurnsWithoutCommands) {
  record::Trajectory circling = drive({{0.4, 1.0, 0.0, 0.0, 13}}),
                     backwards = drive({{-0.3, -0.4, 0.0, 0.0, 5}});
  circling.command_by_second.clear();
  // The chord of a second is 2 sin(1/2) of the arc.
  EXPECT_NEAR(own_speed(circling, context(13)), 0.4 * 2.0 * std::sin(0.5), 1e-4);
  EXPECT_NEAR(own_speed(backwards, context(5)), -0.3 * 2.0 * std::sin(0.2) / 0.4, 1e-4);
  EXPECT_EQ(own_speed(record::Trajectory(), context(5)), 0.0);
}

TEST(Tracking, IsNothingOfARobotThatStandsStillWhateverItIsTold) {
  for (const double speed : {0.0, 0.02, 0.4, -0.3})
    for (const double turn : {0.0, 0.1, -0.8}) {
      const auto standing =
          drive({{0.0, 0.0, speed, turn, 5}, {0.0, 0.0, 0.0, 0.0, 5}, {0.0, 0.0, 0.4, 0.0, 5}});
      EXPECT_EQ(tracking(standing, context(15)), 0.0) << speed << " " << turn;
    }
  EXPECT_EQ(tracking(drive({{0.0, 0.0, 0.0, 0.0, 5}}), context(5)), 1.0);
}

TEST(Tracking, RisesFromStandingStillToWhatIsTold) {
  double before = 0.0;
  for (const double share : {0.25, 0.5, 0.75, 1.0}) {
    const double value = tracking(drive({{0.4 * share, 0.0, 0.4, 0.0, 5}}), context(5));
    EXPECT_NEAR(value, share, 1e-9);
    EXPECT_GT(value, before);
    before = value;
  }
  // Straight on where a turn is told is half of it, and turning on the spot the other half.
  EXPECT_NEAR(tracking(drive({{0.4, 0.0, 0.4, 0.5, 5}}), context(5)), 0.5, 1e-9);
  EXPECT_NEAR(tracking(drive({{0.0, 0.5, 0.4, 0.5, 5}}), context(5)), 0.5, 1e-9);
  EXPECT_NEAR(tracking(drive({{0.0, -0.5, 0.4, 0.5, 5}}), context(5)), 0.0, 1e-9);
}

TEST(Tracking, CountsAStopAsMuchAsAllElse) {
  const auto half = drive({{0.2, 0.0, 0.4, 0.0, 4}, {0.0, 0.0, 0.0, 0.0, 4}});
  EXPECT_NEAR(tracking(half, context(8)), 0.5 * (0.5 + 0.5), 1e-9);
  const auto runs_on = drive({{0.4, 0.0, 0.4, 0.0, 4}, {0.4, 0.0, 0.0, 0.0, 4}});
  EXPECT_NEAR(tracking(runs_on, context(8)), 0.5 * (1.0 + 0.5), 1e-9);
}

TEST(Tracking, OfSecondsThatAFallCutsOffIsNothing) {
  auto fallen = drive({{0.4, 0.0, 0.4, 0.0, 3}});
  fallen.outcome = record::Outcome::fell;
  EXPECT_NEAR(tracking(fallen, context(12)), 0.25, 1e-9);
  fallen = drive({{0.0, 0.0, 0.0, 0.0, 3}});
  fallen.outcome = record::Outcome::fell;
  EXPECT_EQ(tracking(fallen, context(12)), 0.0);
}

TEST(Tracking, TakesMovingSidewaysForAnError) {
  auto sideways = drive({{0.3, 0.0, 0.3, 0.0, 1}});
  sideways.com_by_second_m = {0.0, 0.3};
  EXPECT_NEAR(speed_error(sideways, context(1)), 0.3 * std::numbers::sqrt2, 1e-9);
}

TEST(Tracking, MeasuresErrorsInTheirUnits) {
  const auto trajectory = drive({{0.1, 0.2, 0.4, -0.3, 4}});
  EXPECT_NEAR(turn_error(trajectory, context(4)), 0.5, 1e-9);
  EXPECT_NEAR(heading_error(trajectory, context(4)), 0.5 * (1 + 2 + 3 + 4) / 4, 1e-9);
  EXPECT_NEAR(speed_error(trajectory, context(4)), 0.3, 0.005);
}

TEST(SwitchTime, IsTheMeanOfWholeSecondsUntilTheFirstThatFollows) {
  // Two seconds late, at once, never.
  const auto walk = drive(
      {{0.0, 0.0, 0.4, 0.0, 2}, {0.4, 0.0, 0.4, 0.0, 4}, {0.4, -0.5, 0.4, -0.5, 3}, {0.4, 0.0, 0.0, 0.0, 3}});
  EXPECT_EQ(switch_s(walk, context(12)), (2.0 + 0.0 + 3.0) / 3.0);
}

TEST(SwitchTime, AllowsATenthOfAMetreAndAFifthOfARadianASecond) {
  EXPECT_EQ(switch_s(drive({{0.31, 0.0, 0.4, 0.0, 3}}), context(3)), 0.0);
  EXPECT_EQ(switch_s(drive({{0.29, 0.0, 0.4, 0.0, 3}}), context(3)), 3.0);
  EXPECT_EQ(switch_s(drive({{0.4, 0.19, 0.4, 0.0, 3}}), context(3)), 0.0);
  EXPECT_EQ(switch_s(drive({{0.4, 0.21, 0.4, 0.0, 3}}), context(3)), 3.0);
}

TEST(SwitchTime, CountsARampAsOneChangeAndAStopAtTheStartAsNone) {
  const auto ramp = drive(
      {{0.0, 0.0, 0.0, 0.0, 2}, {0.0, 0.0, 0.2, 0.0, 1}, {0.0, 0.0, 0.4, 0.0, 1}, {0.4, 0.0, 0.4, 0.0, 3}});
  EXPECT_EQ(switch_s(ramp, context(7)), 2.0);
  EXPECT_EQ(switch_s(drive({{0.3, 0.0, 0.0, 0.0, 4}}), context(4)), std::nullopt);
}

TEST(SwitchTime, CountsWhatAFallCutsOffUnlessTheCommandWasFollowedBefore) {
  auto fallen = drive({{0.0, 0.0, 0.4, 0.0, 3}});
  fallen.outcome = record::Outcome::fell;
  EXPECT_EQ(switch_s(fallen, context(12)), 12.0);
  fallen = drive({{0.4, 0.0, 0.4, 0.0, 3}});
  fallen.outcome = record::Outcome::fell;
  EXPECT_EQ(switch_s(fallen, context(12)), 0.0);
}

TEST(SwitchTime, CountsCommandsThatAFallKeptFromComingEachUntilTheNext) {
  auto fallen = drive({{0.4, 0.0, 0.4, 0.0, 3}});
  fallen.outcome = record::Outcome::fell;
  // Another second of the first command, six of a second one, two of a third.
  for (const auto& [seconds, speed_m_s] : {std::pair(1, 0.4), {6, 0.2}, {2, 0.0}})
    for (int i = 0; i < seconds; ++i)
      fallen.command_by_second.insert(fallen.command_by_second.end(), {speed_m_s, 0.0});
  EXPECT_EQ(switch_s(fallen, context(12)), (0.0 + 6.0 + 2.0) / 3.0) << "a stop is a command as well";
  auto at_once = drive({});
  at_once.outcome = record::Outcome::fell;
  for (int i = 0; i < 6; ++i) at_once.command_by_second.insert(at_once.command_by_second.end(), {0.4, 0.0});
  EXPECT_EQ(switch_s(at_once, context(6)), 6.0);
}

}  // namespace
}  // namespace amble::score
