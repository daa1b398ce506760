#include "amble/controllers/oscillators.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "amble/core/error.hpp"
#include "tests/controllers/one_joint.hpp"
#include "tests/controllers/quadruped.hpp"

namespace amble::controllers {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double tick_s = 0.02;

OscillatorSettings settings(PhaseReset reset = PhaseReset::none) {
  return {.least_frequency_hz = 0.5, .most_frequency_hz = 1.5, .reset = reset};
}

/// The target after one more tick, rad.
float target_of(Bench& bench, bool touching) {
  bench.sensors().touch.at(0, 0) = touching ? 1.0f : 0.0f;
  bench.tick();
  return bench.target_rad();
}

TEST(Oscillators, HaveOneOutputForEachParameterAndNoInput) {
  const OscillatorArchitecture architecture(settings(), quadruped(), tick_s);
  EXPECT_TRUE(architecture.cppn_inputs().empty());
  EXPECT_EQ(architecture.cppn_outputs().size(), 2u + 3u * 12u);
  EXPECT_EQ(architecture.cppn_outputs()[2], "FL_knee.amplitude");
}

TEST(Oscillators, SwingAsTheClosedFormWhileBothFrequenciesAreTheSame) {
  const OscillatorArchitecture architecture(settings(), one_joint(), tick_s);
  // 1 Hz, half of the amplitude of 1 rad, an eighth of a turn early, around 0.25 rad.
  Bench bench(architecture, {0.0, 0.0, 0.0, -0.75, 0.25});
  for (int tick = 0; tick < 200; ++tick)
    EXPECT_NEAR(target_of(bench, false),
                0.25 + 0.5 * std::sin(2.0 * std::numbers::pi * (tick * tick_s + 0.125)), 2e-5)
        << tick;
}

TEST(Oscillators, SwingByOneFrequencyAndStandByTheOther) {
  // Ticks so short that it does not matter at which of them the sine changes its sign.
  const OscillatorArchitecture architecture(settings(), one_joint(), 0.0005);
  // 1.5 Hz while the sine is positive, 0.5 Hz else: a third of a second and a second.
  Bench bench(architecture, {1.0, -1.0, 1.0, -1.0, 0.0});
  int swing = 0, stance = 0;
  for (int tick = 0; tick < 160'000; ++tick) ++(target_of(bench, false) > 0.0f ? swing : stance);
  EXPECT_NEAR(static_cast<double>(stance) / swing, 3.0, 0.02);
}

TEST(Oscillators, KeepTheirTargetsInTheRange) {
  const OscillatorArchitecture architecture(settings(), one_joint(), tick_s);
  Bench bench(architecture, {0.0, 0.0, 1.0, -1.0, 0.9});
  float most = 0.0f;
  for (int tick = 0; tick < 100; ++tick) most = std::max(most, target_of(bench, false));
  EXPECT_EQ(most, 1.0f);
}

TEST(Oscillators, AreStartedAnewByAFootThatComesDownIfTheyAreToBe) {
  for (const PhaseReset reset : {PhaseReset::none, PhaseReset::touch}) {
    const OscillatorArchitecture architecture(settings(reset), one_joint(), tick_s);
    Bench bench(architecture, {0.0, 0.0, 1.0, -1.0, 0.0});
    for (int tick = 0; tick < 10; ++tick) target_of(bench, false);
    const float landed = target_of(bench, true), stands = target_of(bench, true);
    if (reset == PhaseReset::touch) {
      EXPECT_EQ(landed, 0.0f);
      EXPECT_GT(stands, 0.1f);
    } else {
      EXPECT_NEAR(landed, std::sin(2.0 * std::numbers::pi * 10 * tick_s), 2e-5);
    }
  }
}

TEST(Oscillators, HoldJointsThatNoLegDrives) {
  robot::RobotSpec robot = one_joint();
  robot::Joint& tail = robot.joints.emplace_back();
  tail.name = "tail";
  tail.lower_rad = 0.25;
  tail.upper_rad = 1.0;
  const OscillatorArchitecture architecture(settings(), robot, tick_s);
  const auto batch = architecture.make_batch(1);
  const auto parameters = architecture.decode(constant_cppn(0, {0, 0, 0, 0, 0}));
  batch->load(0, *parameters);
  LaneArray targets(2, 1);
  batch->step({LaneArray(2, 1), LaneArray(1, 1), LaneArray(3, 1)}, targets);
  EXPECT_EQ(targets.at(1, 0), 0.25f);
}

TEST(Oscillators, OfALaneDoNotDependOnTheOthers) {
  const OscillatorArchitecture architecture(settings(PhaseReset::touch), one_joint(), tick_s);
  const auto slow = architecture.decode(constant_cppn(0, {-1, -1, 0.5, 0.1, 0}));
  const auto fast = architecture.decode(constant_cppn(0, {1, 0, 0.7, -0.3, 0.2}));
  const auto together = architecture.make_batch(3), alone = architecture.make_batch(1);
  for (int lane = 0; lane < 3; ++lane) together->load(lane, lane == 1 ? *fast : *slow);
  alone->load(0, *fast);
  robot::SensorFrame three{LaneArray(1, 3), LaneArray(1, 3), LaneArray(3, 3)},
      one{LaneArray(1, 1), LaneArray(1, 1), LaneArray(3, 1)};
  LaneArray targets(1, 3), target(1, 1);
  for (int tick = 0; tick < 300; ++tick) {
    const float touch = tick % 17 < 8 ? 1.0f : 0.0f;
    three.touch.at(0, 1) = one.touch.at(0, 0) = touch;
    three.touch.at(0, 0) = 1.0f - touch;
    together->step(three, targets);
    alone->step(one, target);
    ASSERT_EQ(targets.at(0, 1), target.at(0, 0)) << tick;
  }
}

TEST(Oscillators, RefuseFrequenciesThatCannotBe) {
  const auto error = [](OscillatorSettings wrong, double timestep_s) -> std::string {
    try {
      OscillatorArchitecture(wrong, one_joint(), timestep_s);
    } catch (const UserError& refusal) {
      return refusal.what();
    }
    return {};
  };
  EXPECT_THAT(error({.least_frequency_hz = 2.0, .most_frequency_hz = 1.0}, tick_s),
              HasSubstr("least_frequency_hz = 2"));
  EXPECT_THAT(error({.least_frequency_hz = 2.0, .most_frequency_hz = 40.0}, tick_s),
              HasSubstr("half a turn a tick"));
}

TEST(SineOfTurns, IsTheSine) {
  for (int i = -1000; i <= 1000; ++i) {
    const float x = static_cast<float>(i) / 1000.0f;
    EXPECT_NEAR(sine_of_turns(x), std::sin(2.0 * std::numbers::pi * static_cast<double>(x)), 3e-7) << x;
  }
}

}  // namespace
}  // namespace amble::controllers
