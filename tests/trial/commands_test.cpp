#include "amble/trial/commands.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "amble/core/error.hpp"
#include "amble/robot/spec.hpp"
#include "amble/trial/scenario.hpp"

namespace amble::trial {
namespace commands_test {

constexpr double tick_s = 0.01;

CommandSettings fixed(std::vector<CommandStretch> stretches, double ramp_s = 0.0) {
  return {.kind = CommandKind::fixed, .stretches = std::move(stretches), .ramp_s = ramp_s};
}

TEST(Commands, AreNoneByDefault) {
  EXPECT_TRUE(CommandSettings().is_default());
  EXPECT_FALSE(planned_commands({}, 1500, tick_s));
}

TEST(Commands, WithoutSecondsShareTheRestOfATrial) {
  const auto schedule = planned_commands(fixed({{0.4, 0.0}, {0.4, 0.5, 3.0}, {0.0, 0.0}}), 1500, tick_s);
  EXPECT_EQ(schedule->at(0), (Command{0.4f, 0.0f}));
  EXPECT_EQ(schedule->at(599), (Command{0.4f, 0.0f}));
  EXPECT_EQ(schedule->at(600), (Command{0.4f, 0.5f}));
  EXPECT_EQ(schedule->at(899), (Command{0.4f, 0.5f}));
  EXPECT_TRUE(schedule->at(900).is_stop());
  EXPECT_TRUE(schedule->at(100000).is_stop());
}

TEST(Commands, ChangeInARampFromRestAndFromTheOneBefore) {
  const auto schedule = planned_commands(fixed({{1.0, 0.0, 5.0}, {0.0, -1.0, 5.0}}, 1.0), 1000, tick_s);
  EXPECT_FLOAT_EQ(schedule->at(0).speed_m_s, 0.01f);
  EXPECT_FLOAT_EQ(schedule->at(49).speed_m_s, 0.5f);
  EXPECT_EQ(schedule->at(99).speed_m_s, 1.0f);
  EXPECT_FLOAT_EQ(schedule->at(524).speed_m_s, 0.75f);
  EXPECT_FLOAT_EQ(schedule->at(524).turn_rad_s, -0.25f);
  EXPECT_EQ(schedule->at(700), (Command{0.0f, -1.0f}));
}

TEST(Commands, OfRandomTrialsGoAllRoundWhereNothingIsDrawn) {
  const CommandSettings settings{.kind = CommandKind::random, .most_speed_m_s = 0.3, .most_turn_rad_s = 0.6};
  const auto schedule = planned_commands(settings, 400, tick_s);
  EXPECT_EQ(schedule->at(50), (Command{0.3f, 0.0f}));
  EXPECT_EQ(schedule->at(150), (Command{0.3f, 0.6f}));
  EXPECT_EQ(schedule->at(250), (Command{0.3f, -0.6f}));
  EXPECT_TRUE(schedule->at(350).is_stop());
}

TEST(Commands, AreDrawnWithinTheirBoundsAndShares) {
  const CommandSettings settings{.kind = CommandKind::random,
                                 .stretch_s = 1.0,
                                 .least_speed_m_s = 0.1,
                                 .most_speed_m_s = 0.5,
                                 .most_turn_rad_s = 0.8,
                                 .straight_share = 0.3,
                                 .stop_share = 0.2};
  constexpr int count = 20000;
  const auto schedule = drawn_commands(settings, count * 100, tick_s, Stream(3, Purpose::test), false);
  int stops = 0, straights = 0;
  double speed = 0.0, turn = 0.0;
  for (const auto& [first, command] : schedule.stretches()) {
    if (command.is_stop()) {
      ++stops;
      continue;
    }
    straights += command.turn_rad_s == 0.0f ? 1 : 0;
    EXPECT_GE(command.speed_m_s, 0.1f);
    EXPECT_LE(command.speed_m_s, 0.5f);
    EXPECT_LE(std::fabs(command.turn_rad_s), 0.8f);
    speed += static_cast<double>(command.speed_m_s);
    turn += static_cast<double>(command.turn_rad_s);
  }
  EXPECT_EQ(schedule.stretches().size(), static_cast<std::size_t>(count));
  EXPECT_NEAR(stops, 0.2 * count, 4.0 * std::sqrt(0.16 * count));
  EXPECT_NEAR(straights, 0.3 * count, 4.0 * std::sqrt(0.21 * count));
  EXPECT_NEAR(speed / (count - stops), 0.3, 0.005);
  EXPECT_NEAR(turn / (count - stops), 0.0, 0.015);
}

TEST(Commands, OfALongerTrialBeginAsThoseOfAShorterOne) {
  const CommandSettings settings{.kind = CommandKind::random, .stretch_s = 2.0};
  const auto shorter = drawn_commands(settings, 500, tick_s, Stream(5, Purpose::test), false);
  const auto longer = drawn_commands(settings, 5000, tick_s, Stream(5, Purpose::test), false);
  for (int tick = 0; tick < 500; ++tick) EXPECT_EQ(shorter.at(tick), longer.at(tick));
}

Scenario scenario_of(const CommandSettings& settings, std::uint32_t generation, std::uint32_t episode,
                     const NoiseSettings& noise = {}) {
  return draw_scenario(noise, robot::RobotSpec(), 1500, tick_s, {7, generation, episode}, {}, settings);
}

TEST(Commands, OfEverySecondEpisodeAreThoseBeforeMirrored) {
  CommandSettings settings{.kind = CommandKind::random};
  const auto one = scenario_of(settings, 3, 2).commands, other = scenario_of(settings, 3, 3).commands;
  for (int tick = 0; tick < 1500; ++tick) {
    EXPECT_EQ(one->at(tick).speed_m_s, other->at(tick).speed_m_s);
    EXPECT_EQ(one->at(tick).turn_rad_s, -other->at(tick).turn_rad_s);
  }
  settings.mirrored = false;
  EXPECT_NE(scenario_of(settings, 3, 3).commands->at(0), other->at(0));
}

TEST(Commands, AreNewInEachGenerationAndThereWithoutNoise) {
  const CommandSettings settings{.kind = CommandKind::random};
  EXPECT_NE(scenario_of(settings, 1, 0).commands->at(0), scenario_of(settings, 2, 0).commands->at(0));
  EXPECT_EQ(scenario_of(settings, 1, 0).commands->at(0), scenario_of(settings, 1, 0).commands->at(0));
  const NoiseSettings noise{.episodes = 2, .first_undisturbed = true, .push_m_s = 0.1};
  EXPECT_EQ(scenario_of(settings, 1, 0, noise).commands->at(0), scenario_of(settings, 1, 0).commands->at(0));
  EXPECT_FALSE(scenario_of({}, 1, 0).commands);
}

TEST(Commands, AreReadFromOneLine) {
  const auto stretches = parse_commands("0.4,0; 0.4,-0.5,2.5 ;0,0");
  EXPECT_EQ(stretches, (std::vector<CommandStretch>{{0.4, 0.0}, {0.4, -0.5, 2.5}, {0.0, 0.0}}));
  for (const char* const bad :
       {"", "0.4", "0.4,x", "0.4,0,1,2", "0.4,0;", "1e9,0", "0,0,-1", "nan,0", "0,0,1e300", "0,0,inf"})
    EXPECT_THROW(parse_commands(bad), UserError) << bad;
}

TEST(Commands, OutOfTheirRangesAreRefusedWithTheRange) {
  const auto refusal = [](const char* text) -> std::string {
    try {
      parse_commands(text);
    } catch (const UserError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal("0,0; 1e3,0"),
            "command \"1e3,0\": speed = 1000: expected a number from -100 to 100 (m/s)");
  EXPECT_EQ(refusal("0,-101"),
            "command \"0,-101\": turn = -101: expected a number from -100 to 100 (rad/s to the left)");
  for (const char* const bad : {"nan,0", "-inf,0", "1e400,0", "0,nan", "0,0,-1", "0,0,1e300"})
    EXPECT_NE(refusal(bad).find(": expected a number from "), std::string::npos) << refusal(bad);
  EXPECT_EQ(refusal("0.2,0;").find("command \"0.2,0;\": expected SPEED,TURN"), 0u);
}

TEST(Commands, OfTheLongestTimesAndShortestTicksCountOn) {
  CommandSettings settings{.kind = CommandKind::fixed,
                           .stretches = {{0.1, 0.0, 1e6}, {0.2, 0.0, 1e6}, {0.3, 0.0, 1e6}},
                           .ramp_s = 1e6};
  const CommandSchedule schedule = planned_commands(settings, 1000, 1e-5).value();
  EXPECT_LT(schedule.at(999).speed_m_s, 0.1f);
  EXPECT_GT(schedule.at(999).speed_m_s, 0.0f);
}

std::string refusal(const CommandSettings& settings) {
  try {
    settings.validate({});
  } catch (const UserError& error) {
    return error.what();
  }
  return "none";
}

TEST(Commands, ThatMakeNoSenseAreRefused) {
  EXPECT_EQ(refusal({}), "none");
  EXPECT_EQ(refusal(fixed({{0.4, 0.0}})), "none");
  EXPECT_NE(refusal(fixed({})).find("needs a list"), std::string::npos);
  EXPECT_EQ(refusal(fixed({{0.4, 0.0, 20.0}, {0.0, 0.0}})),
            "command.stretches: 20 s of them leave nothing of a trial of 15 s for those without seconds");
  EXPECT_EQ(refusal({.kind = CommandKind::random, .least_speed_m_s = 1.0}),
            "command.least_speed_m_s = 1: expected at most command.most_speed_m_s = 0.4");
  EXPECT_EQ(refusal({.kind = CommandKind::random, .straight_share = 0.6, .stop_share = 0.5}),
            "command.straight_share + command.stop_share = 1.1: expected at most 1");
  EXPECT_EQ(refusal({.kind = CommandKind::random, .stretch_s = 0.005}),
            "command.stretch_s = 0.005: expected at least one timestep, 0.01 s");
}

TEST(CommandSchedule, GoesOnByAnotherCommandFromTheTickInWhichItIsChanged) {
  CommandSchedule schedule({{0, {0.4f, 0.0f}}, {100, {0.0f, 0.5f}}, {200, {0.2f, 0.0f}}}, 0);
  schedule.change(150, {0.1f, -0.2f});
  EXPECT_EQ(schedule.at(149), (Command{0.0f, 0.5f}));
  for (const int tick : {150, 200, 100000}) EXPECT_EQ(schedule.at(tick), (Command{0.1f, -0.2f})) << tick;
  schedule.change(100, {0.3f, 0.0f});
  EXPECT_EQ(schedule.at(99), (Command{0.4f, 0.0f}));
  EXPECT_EQ(schedule.at(150), (Command{0.3f, 0.0f}));
  schedule.change(0, {});
  EXPECT_EQ(schedule.at(0), Command());
}

TEST(CommandSchedule, RampsFromWhereAnUnfinishedRampWas) {
  CommandSchedule schedule({{0, {}}}, 10);
  schedule.change(100, {1.0f, 0.0f});
  schedule.change(104, {});
  EXPECT_EQ(schedule.at(103).speed_m_s, 0.4f);
  float before_m_s = schedule.at(103).speed_m_s;
  for (int tick = 104; tick < 114; ++tick) {
    EXPECT_LT(schedule.at(tick).speed_m_s, before_m_s) << tick;
    before_m_s = schedule.at(tick).speed_m_s;
  }
  EXPECT_EQ(before_m_s, 0.0f);
}

}  // namespace commands_test
}  // namespace amble::trial
