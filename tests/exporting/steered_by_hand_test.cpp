#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

#include "amble/experiment/steering.hpp"
#include "amble/io/file.hpp"
#include "tests/exporting/champions.hpp"
#include "tests/exporting/compiled.hpp"
#include "tests/io/temporary_folder.hpp"

namespace amble::tests {
namespace {

using experiment::HandSteering;
using test::TemporaryFolder;

/// Of each kind of controller those that hear nothing, and those that hear commands themselves; with other
/// sensors, guessed contacts and smoothed targets.
std::vector<Sample> walkers() {
  constexpr std::array<std::string_view, 19> chosen{
      "quadruped_supg", "hexapod_sine",   "recurrent_sine", "quadruped_ctrnn", "ctrnn_runge_kutta",
      "paper_ctrnn",    "residual",       "filtered",       "modulated",       "modulated_rate",
      "torque_contact", "shock_contact",  "load_feedback",  "obeying",         "oscillators_reset",
      "mixed",          "mixed_by_shock", "ctrnn_obeying",  "ctrnn_feeling"};
  std::vector<Sample> some;
  for (const auto& samples : {twenty_samples(), seam_samples(), modulated_samples(), sensing_samples()})
    std::ranges::copy_if(samples, std::back_inserter(some), [&chosen](const Sample& sample) {
      return std::ranges::find(chosen, sample.name) != chosen.end();
    });
  EXPECT_EQ(some.size(), chosen.size());
  return some;
}

class EachWalker : public testing::TestWithParam<Sample> {};
INSTANTIATE_TEST_SUITE_P(SteeredByHand, EachWalker, testing::ValuesIn(walkers()),
                         [](const auto& sample) { return sample.param.name; });

constexpr std::string_view strict_c99 = "-std=c99 -pedantic -Wall -Wextra -Werror -DWALKER_SELF_TEST";

TEST_P(EachWalker, CompilesAndPassesItsSelfTestWhateverTheGains) {
  experiment::Champion champion = evolve(GetParam());
  champion.problem.set_commands(
      {.kind = trial::CommandKind::fixed, .stretches = {{0.3, 0.0}, {0.3, 0.3}, {0.2, -0.3}, {}}});
  for (const auto& [gains, heading] :
       {HandSteering{{.turn_gain = 2.0}}, HandSteering{{.full_speed_m_s = 0.3}},
        HandSteering{{.turn_gain = 2.0, .heading_gain = 0.5}},
        HandSteering{{.turn_gain = 2.0, .heading_gain = 0.5}, {.lead_rad = 0.02}},
        HandSteering{{.turn_gain = 2.0,
        .full_speed_m_s = 0.3,
        .heading_gain = 0.5,
        .change_s = 0.2,
        .about = controllers::SwingCentre::middle}}}) {
    SCOPED_TRACE(testing::Message() << "turn_gain = " << gains.turn_gain << ", heading_gain = "
                                    << gains.heading_gain << ", full_speed_m_s = " << gains.full_speed_m_s);
    const TemporaryFolder scratch;
    experiment::Champion steered = champion;
    experiment::steer_by_hand(steered.problem, {gains, heading});
    write_walker(scratch.path(), steered);
    ASSERT_EQ(compile(scratch.path(), "gcc", std::string(strict_c99), {}, "self"), "");
    EXPECT_EQ(run_shell("'" + (scratch / "self").string() + "'").out,
              "walker: 100 ticks, largest error 0 rad\n");
    EXPECT_THAT(compile(scratch.path(), "gcc", "-std=c99 -ffast-math -fsyntax-only", {}, "fast"),
                testing::HasSubstr("compile without -ffast-math"));
  }
}

/// What a program says that drives a plain walker, made to be told 0.3 m/s and a turn and steered by hand.
std::string said_by(std::string_view main, double turn_rad_s, const HandSteering& steering) {
  const auto samples = walkers();
  const auto plain = std::ranges::find(samples, "quadruped_supg", &Sample::name);
  if (plain == samples.end()) return "there is no such walker";
  experiment::Champion champion = evolve(*plain);
  champion.problem.set_commands({.kind = trial::CommandKind::fixed, .stretches = {{0.3, turn_rad_s}}});
  experiment::steer_by_hand(champion.problem, steering);
  const TemporaryFolder scratch;
  write_walker(scratch.path(), champion);
  io::write_file(scratch / "drive.c", main);
  const std::string trouble = compile(scratch.path(), "gcc", strict_flags, scratch / "drive.c", "drive");
  return trouble.empty() ? run_shell("'" + (scratch / "drive").string() + "'").out : trouble;
}

/// Two walkers that turn by a half of what they are told: the yaw of one is wrapped, that of the other
/// counted on from two turns to the left.
constexpr std::string_view turning_main = R"(#include <stdio.h>
#include "walker.h"
int main(void) {
  walker_state wrapped, counted;
  walker_sensors in = {0};
  walker_targets targets;
  float yaw = 0.0f, within = 0.0f;
  walker_init(&wrapped);
  walker_init(&counted);
  walker_set_command(&wrapped, 0.3f, 0.5f);
  walker_set_command(&counted, 0.3f, 0.5f);
  for (int tick = 0; tick < 5000; ++tick) {
    in.yaw_rad = within;
    walker_step(&wrapped, &in, &targets);
    in.yaw_rad = yaw + 12.5663706f;
    walker_step(&counted, &in, &targets);
    const float apart = wrapped.heading_error_rad - counted.heading_error_rad;
    const float short_way = apart > 3.0f ? apart - 6.28318531f : apart < -3.0f ? apart + 6.28318531f : apart;
    if (short_way > 0.001f || short_way < -0.001f || wrapped.heading_error_rad > 3.142f || counted.heading_error_rad > 3.142f)
      printf("tick %d: %g and %g\n", tick, (double)wrapped.heading_error_rad, (double)counted.heading_error_rad);
    yaw += 0.0025f;
    within += 0.0025f;
    if (within > 3.14159265f) within -= 6.28318531f;
  }
  in.yaw_rad = 1e9f;
  walker_step(&counted, &in, &targets);
  printf("%.1f, %g\n", (double)yaw, (double)counted.heading_error_rad);
  return 0;
}
)";

TEST(SteeredByHand, AYawThatIsCountedOnFromTurnToTurnIsAsGoodAsOneWithinHalfATurn) {
  EXPECT_EQ(said_by(turning_main, 0.5, {{.turn_gain = 1.0, .heading_gain = 1.0}, {}}), "12.5, 0\n");
}

/// A walker that is told to turn left for ten seconds and cannot, and then right.
constexpr std::string_view blocked_main = R"(#include <stdio.h>
#include "walker.h"
int main(void) {
  walker_state state;
  walker_sensors in = {0};
  walker_targets targets;
  int tick;
  in.yaw_rad = 3.0f;
  walker_init(&state);
  walker_set_command(&state, 0.3f, 0.5f);
  for (tick = 0; tick < 1000; ++tick) walker_step(&state, &in, &targets);
  printf("%.3f ", (double)state.heading_error_rad);
  walker_set_command(&state, 0.3f, -0.5f);
  for (tick = 0; tick < 101; ++tick) walker_step(&state, &in, &targets);
  printf("%.3f\n", (double)state.heading_error_rad);
  return 0;
}
)";

TEST(SteeredByHand, AHeadingIsAheadOfABlockedRobotByItsLeadAndComesBackAtOnce) {
  EXPECT_EQ(said_by(blocked_main, 0.5, {{.turn_gain = 1.0, .heading_gain = 1.0}, {.lead_rad = 0.75}}),
            "0.750 0.250\n");
}

/// A walker that is told to turn, and whose yaw is lost.
constexpr std::string_view lost_main = R"(#include <math.h>
#include <stdio.h>
#include "walker.h"
int main(void) {
  walker_state state;
  walker_sensors in = {0};
  walker_targets targets;
  int tick;
  walker_init(&state);
  walker_set_command(&state, 0.3f, 0.35f);
  for (tick = 0; tick < 200; ++tick) {
    in.yaw_rad = tick < 100 ? (float)tick * 0.0035f : NAN;
    walker_step(&state, &in, &targets);
  }
  printf("%.2f %.2f %.3f\n", (double)state.factor[0], (double)state.factor[1], (double)state.heading_error_rad);
  return 0;
}
)";

TEST(SteeredByHand, ATurnIsStillObeyedWhereTheYawIsLost) {
  EXPECT_EQ(said_by(lost_main, 0.35, {{.turn_gain = 2.0, .heading_gain = 2.0}, {}}), "0.30 1.00 0.000\n");
}

}  // namespace
}  // namespace amble::tests
