#include "amble/controllers/supg_batch.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "amble/core/random.hpp"
#include "tests/controllers/supg_substrate.hpp"

namespace amble::controllers {
namespace supg_batch_test {

constexpr double timestep_s = 0.01;
constexpr int legs = 4, types = 3, period = 6;

SupgSettings short_settings() {
  SupgSettings settings;
  settings.period_s = period * timestep_s;
  return settings;
}

/// Targets tell joint, timer and controller apart.
SupgParameters numbered_parameters(int number) {
  SupgParameters parameters(legs, types, period);
  for (int leg = 0; leg < legs; ++leg)
    for (int timer = SupgParameters::stopped; timer <= period; ++timer)
      for (int type = 0; type < types; ++type)
        parameters.targets_rad(leg, timer)[type] =
            static_cast<float>(number * 10000 + (leg * types + type) * 100 + timer + 1);
  return parameters;
}

struct TimerStory {
  std::string timers;    ///< of the front left leg, one character per tick; '-' while stopped
  std::string triggers;  ///< '^' where one fired
};

/// Plays a written contact sequence ('#' foot down, '.' foot up) of the front left foot; the others stay
/// down.
TimerStory play(const SupgSettings& settings, int offset_ticks, const std::string& contacts) {
  const SupgArchitecture architecture(settings, supg_substrate(), quadruped(), timestep_s);
  SupgParameters parameters = numbered_parameters(1);
  parameters.set_offset_ticks(0, offset_ticks);
  const std::unique_ptr<Batch> batch = architecture.make_batch(1);
  batch->load(0, parameters);

  robot::SensorFrame sensors{LaneArray(legs * types, 1), LaneArray(legs, 1), LaneArray(3, 1)};
  sensors.touch.set_lane(0, 1.0f);
  LaneArray targets(legs * types, 1);
  TimerStory story;
  std::vector<float> state(2 * legs);
  for (const char contact : contacts) {
    sensors.touch.at(0, 0) = contact == '#' ? 1.0f : 0.0f;
    batch->step(sensors, targets);
    batch->state(0, state);
    const int timer = static_cast<int>(state[0]);
    story.timers += timer == SupgParameters::stopped ? '-' : static_cast<char>('0' + timer);
    story.triggers += state[legs] == 1.0f ? '^' : ' ';
    for (int type = 0; type < types; ++type)
      EXPECT_EQ(targets.at(type, 0), parameters.targets_rad(0, timer)[type]);
  }
  return story;
}

// The period is 6 ticks. Each story: the foot's contact, the timer expected of the first leg, and the ticks
// of triggers.

TEST(SupgTimer, StopsAtTheEndOfTheCycleWithMid) {
  const TimerStory story = play(short_settings(), 2, "####..########.#");
  EXPECT_EQ(story.timers, /*                      */ "345---12345----1");
  EXPECT_EQ(story.triggers, /*                    */ "      ^        ^");
}

TEST(SupgTimer, KeepsItsLastValueWithHold) {
  SupgSettings settings = short_settings();
  settings.idle = Idle::hold;
  const TimerStory story = play(settings, 2, "####..########.#");
  EXPECT_EQ(story.timers, /*              */ "3456661234566661");
  EXPECT_EQ(story.triggers, /*            */ "      ^        ^");
}

TEST(SupgTimer, BeginsAgainWithWrap) {
  SupgSettings settings = short_settings();
  settings.idle = Idle::wrap;
  const TimerStory story = play(settings, 2, "####..########.#");
  EXPECT_EQ(story.timers, /*              */ "3450121234501231");
  EXPECT_EQ(story.triggers, /*            */ "      ^        ^");
}

TEST(SupgTimer, StartsFromZeroWhereTheSettingSaysSo) {
  SupgSettings settings = short_settings();
  settings.start_tick = 0;
  const TimerStory story = play(settings, 4, "##.#########.#");
  EXPECT_EQ(story.timers, /*              */ "5--012345----0");
  EXPECT_EQ(story.triggers, /*            */ "   ^         ^");
}

TEST(SupgTimer, EndsItsCycleAtOnceWithTheLargestOffset) {
  SupgSettings settings = short_settings();
  EXPECT_EQ(play(settings, period - 1, "###").timers, "---");
  settings.idle = Idle::hold;
  EXPECT_EQ(play(settings, period - 1, "###").timers, "666");
  settings.idle = Idle::wrap;
  EXPECT_EQ(play(settings, period - 1, "###").timers, "012");
}

TEST(SupgTimer, IsSetAnewByATriggerInMidCycle) {
  const TimerStory story = play(short_settings(), 1, "#.#.#..#.");
  EXPECT_EQ(story.timers, /*                      */ "231212312");
  EXPECT_EQ(story.triggers, /*                    */ "  ^ ^  ^ ");
}

TEST(SupgTimer, IgnoresTriggersOnTickOneWhateverTheFootTouches) {
  // A foot on the ground at the start has touched before; one that is up and lands on tick 2 triggers there.
  EXPECT_EQ(play(short_settings(), 3, "###").timers, "45-");
  const TimerStory story = play(short_settings(), 3, ".##");
  EXPECT_EQ(story.timers, "412");
  EXPECT_EQ(story.triggers, " ^ ");
}

TEST(SupgTimer, WaitsOutADelayAndIgnoresTriggersMeanwhile) {
  SupgSettings settings = short_settings();
  settings.offset = Offset::delay;
  TimerStory story = play(settings, 3, "#.##.######.#");
  EXPECT_EQ(story.timers, /*        */ "---1212345--1");
  EXPECT_EQ(story.triggers, /*      */ "     ^      ^");

  settings.start_tick = 0;
  settings.idle = Idle::wrap;
  story = play(settings, 2, "##########");
  EXPECT_EQ(story.timers, "--01234501");
  EXPECT_EQ(story.triggers, "          ");
}

TEST(SupgTimer, AbsorbsATriggerOnTheTickOfItsFirstStart) {
  SupgSettings settings = short_settings();
  settings.offset = Offset::delay;
  const TimerStory story = play(settings, 3, "##.##.#");
  EXPECT_EQ(story.timers, /*              */ "---1231");
  EXPECT_EQ(story.triggers, /*            */ "      ^");
}

TEST(SupgTimer, IsHeldAtItsStartWhileTheFootIsDownWithLevel) {
  SupgSettings settings = short_settings();
  settings.trigger = Trigger::level;
  TimerStory story = play(settings, 2, "##..##.......#");
  EXPECT_EQ(story.timers, /*        */ "3123112345---1");
  EXPECT_EQ(story.triggers, /*      */ " ^  ^^       ^");

  settings.offset = Offset::delay;
  story = play(settings, 2, "####.#");
  EXPECT_EQ(story.timers, /**/ "--1121");
  EXPECT_EQ(story.triggers, /**/ "   ^ ^");
}

TEST(SupgTimer, IgnoresContactChatterWithDebounce) {
  SupgSettings settings = short_settings();
  settings.trigger_debounce_ticks = 3;
  settings.idle = Idle::wrap;
  const TimerStory story = play(settings, 1, "#.#..#...#.#...");
  EXPECT_EQ(story.timers, /*              */ "234501234123450");
  EXPECT_EQ(story.triggers, /*            */ "         ^     ");
}

TEST(SupgTimer, RunsOnByItselfWithoutATrigger) {
  SupgSettings settings = short_settings();
  settings.trigger = Trigger::none;
  settings.idle = Idle::wrap;
  const TimerStory story = play(settings, 3, "#.##.######.#");
  EXPECT_EQ(story.timers, /*              */ "4501234501234");
  EXPECT_EQ(story.triggers, /*            */ "             ");
}

TEST(SupgTimer, IsTriggeredByChanceWhateverItsFootDoes) {
  SupgSettings settings = short_settings();
  settings.trigger = Trigger::random;
  const std::string down(600, '#'), up(600, '.');
  const TimerStory story = play(settings, 3, down);
  EXPECT_EQ(story.timers, play(settings, 3, up).timers);
  std::vector<std::size_t> moments;
  for (std::size_t tick = 0; tick < story.triggers.size(); ++tick)
    if (story.triggers[tick] == '^') moments.push_back(tick);
  std::set<std::size_t> gaps;
  for (std::size_t i = 1; i < moments.size(); ++i) gaps.insert(moments[i] - moments[i - 1]);
  EXPECT_EQ(gaps, (std::set<std::size_t>{3, 4, 5, 6, 7, 8, 9})) << "a period of 6 ticks, and half of one";
  EXPECT_NEAR(static_cast<double>(moments.size()), 100.0, 7.0) << "a period apart on average";
}

TEST(SupgTimer, GivesEachLegItsOwnTimerAndOffset) {
  const SupgArchitecture architecture(short_settings(), supg_substrate(), quadruped(), timestep_s);
  SupgParameters parameters = numbered_parameters(1);
  for (int leg = 0; leg < legs; ++leg) parameters.set_offset_ticks(leg, 1 + leg);
  const std::unique_ptr<Batch> batch = architecture.make_batch(1);
  batch->load(0, parameters);
  EXPECT_EQ(batch->state_names(),
            (std::vector<std::string>{"timer.FL", "timer.FR", "timer.BL", "timer.BR", "trigger.FL",
                                      "trigger.FR", "trigger.BL", "trigger.BR"}));

  robot::SensorFrame sensors{LaneArray(legs * types, 1), LaneArray(legs, 1), LaneArray(3, 1)};
  LaneArray targets(legs * types, 1);
  std::vector<float> state(2 * legs);
  batch->step(sensors, targets);  // all feet are up
  sensors.touch.at(2, 0) = 1.0f;
  batch->step(sensors, targets);  // back left comes down
  batch->state(0, state);
  EXPECT_EQ(state, (std::vector<float>{3, 4, 1, -1, 0, 0, 1, 0}));
  EXPECT_EQ(targets.at(7, 0), parameters.targets_rad(2, 1)[1]);
  EXPECT_EQ(targets.at(11, 0), parameters.targets_rad(3, SupgParameters::stopped)[2]);
}

TEST(SupgBatchDeathTest, RefusesParametersOfAnotherArchitecture) {
  const SupgArchitecture architecture(short_settings(), supg_substrate(), quadruped(), timestep_s);
  const std::unique_ptr<Batch> batch = architecture.make_batch(1);
  EXPECT_DEATH(batch->load(0, SupgParameters(legs, types, period + 1)), "another architecture");
  EXPECT_DEATH(batch->load(1, numbered_parameters(1)), "no such lane");
}

}  // namespace supg_batch_test
}  // namespace amble::controllers
