#include "amble/trial/senses.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "tests/trial/fakes.hpp"

namespace amble::trial {
namespace {

using substrate::Sensor;
using Kind = Sensor::Kind;

constexpr double timestep_s = 0.01;

/// An engine of one lane whose joint is at 0.03 t − 0.001 t² rad in tick t, and whose yaw turns by 0.2 rad a
/// tick, beyond π.
struct Turning {
  explicit Turning(const Sensing& sensing, const Scenario* scenario = nullptr)
      : senses(sensing, engine.sensors(), timestep_s) {
    set();
    senses.load(0, engine, scenario);
  }
  double angle_rad(int t) const { return 0.03 * t - 0.001 * t * t; }
  void set() {
    engine.frame().joint_angle_rad.at(0, 0) = static_cast<float>(angle_rad(tick));
    engine.frame().attitude_rad.at(2, 0) = static_cast<float>(std::remainder(3.0 + 0.2 * tick, 2.0 * M_PI));
    engine.frame().touch.at(0, 0) = tick % 2 == 0 ? 1.0f : 0.0f;
  }
  const robot::SensorFrame& read() {
    set();
    ++tick;
    return senses.read(engine);
  }

  FakeEngine engine{1};
  int tick = 0;
  Senses senses;
};

controllers::SensorModel model(Kind kind, float noise, int delay_ticks, int hold_ticks = 1) {
  return {.sensor = {kind, 0}, .noise = noise, .delay_ticks = delay_ticks, .hold_ticks = hold_ticks};
}

TEST(Senses, WithoutAnythingToDoAreTheEnginesOwn) {
  Turning robot({});
  EXPECT_EQ(&robot.read(), &robot.engine.sensors());
}

TEST(Senses, ThatNobodyReadsMayBeLateAndNoisy) {
  for (const Kind kind : {Kind::speed, Kind::torque, Kind::yaw_rate, Kind::load, Kind::command_speed,
                          Kind::command_turn, Kind::command_stop, Kind::heading_error}) {
    Turning robot({.extra = {}, .models = {model(kind, 0.1f, 3, 2)}});
    for (int t = 0; t < 5; ++t) EXPECT_EQ(&robot.read(), &robot.engine.sensors());
  }
  Turning robot({.extra = {.yaw_rate = true}, .models = {model(Kind::speed, 0.0f, 3)}});
  for (int t = 0; t < 5; ++t) EXPECT_EQ(robot.read().joint_speed_rad_s.rows(), 0);
}

TEST(Senses, TakeRatesFromTickToTickAndAcrossTheHalfTurn) {
  Turning robot({.extra = {.speed = true, .yaw_rate = true}, .models = {}});
  EXPECT_EQ(robot.read().joint_speed_rad_s.at(0, 0), 0.0f);
  for (int t = 1; t < 30; ++t) {
    const robot::SensorFrame& sensors = robot.read();
    EXPECT_NEAR(sensors.joint_speed_rad_s.at(0, 0),
                (robot.angle_rad(t) - robot.angle_rad(t - 1)) / timestep_s, 1e-4);
    EXPECT_NEAR(sensors.yaw_rate_rad_s.at(0, 0), 20.0, 1e-3);
    EXPECT_EQ(sensors.joint_angle_rad.at(0, 0), robot.engine.sensors().joint_angle_rad.at(0, 0));
  }
}

TEST(Senses, ReadADelayedSensorAsItWasAndBeforeThatAsAtTheStart) {
  Turning robot({.extra = {}, .models = {model(Kind::angle, 0.0f, 4)}});
  for (int t = 0; t < 30; ++t) {
    const robot::SensorFrame& sensors = robot.read();
    EXPECT_EQ(sensors.joint_angle_rad.at(0, 0), static_cast<float>(robot.angle_rad(std::max(t - 4, 0)))) << t;
    EXPECT_EQ(sensors.touch.at(0, 0), robot.engine.sensors().touch.at(0, 0));
  }
}

TEST(Senses, HoldAReadingForTheDeadTime) {
  Turning robot({.extra = {}, .models = {model(Kind::angle, 0.0f, 2, 5)}});
  for (int t = 0; t < 30; ++t)
    EXPECT_EQ(robot.read().joint_angle_rad.at(0, 0),
              static_cast<float>(robot.angle_rad(std::max(t / 5 * 5 - 2, 0))))
        << t;
}

std::vector<float> noisy_readings(std::uint32_t generation) {
  Scenario scenario;
  scenario.readings = Stream(7, Purpose::trial_noise, generation);
  Turning robot({.extra = {}, .models = {model(Kind::touch, 0.0f, 0), model(Kind::angle, 0.02f, 0)}},
                &scenario);
  std::vector<float> readings;
  for (int t = 0; t < 200; ++t) {
    readings.push_back(robot.read().joint_angle_rad.at(0, 0));
    EXPECT_LE(std::fabs(static_cast<double>(readings.back()) - robot.angle_rad(t)), 0.02 + 1e-5);
  }
  return readings;
}

TEST(Senses, AddNoiseThatIsTheTrialsAlone) {
  EXPECT_EQ(noisy_readings(1), noisy_readings(1));
  EXPECT_NE(noisy_readings(1), noisy_readings(2));
  Turning without({.extra = {}, .models = {model(Kind::angle, 0.02f, 0)}});
  for (int t = 0; t < 5; ++t)
    EXPECT_EQ(without.read().joint_angle_rad.at(0, 0), static_cast<float>(without.angle_rad(t)));
}

TEST(Senses, BeginAnewWithEachTrial) {
  Turning robot({.extra = {.speed = true}, .models = {model(Kind::angle, 0.0f, 3)}});
  for (int t = 0; t < 10; ++t) robot.read();
  robot.set();
  robot.senses.load(0, robot.engine, nullptr);
  const robot::SensorFrame& sensors = robot.read();
  EXPECT_EQ(sensors.joint_speed_rad_s.at(0, 0), 0.0f);
  EXPECT_EQ(sensors.joint_angle_rad.at(0, 0), static_cast<float>(robot.angle_rad(10)));
}

CommandSchedule turning_left(float rad_s) {
  return {{{0, {0.3f, rad_s}}, {500, {0.0f, 0.0f}}}, 0};
}

TEST(Senses, TellWhatIsCommandedInEachTick) {
  const CommandSchedule schedule = turning_left(0.5f);
  FakeEngine engine(2);
  Senses senses({.extra = {.command = true}, .models = {}}, engine.sensors(), timestep_s);
  senses.load(0, engine, nullptr, &schedule);
  senses.load(1, engine, nullptr, nullptr);
  for (int tick = 0; tick < 600; ++tick) {
    const robot::SensorFrame& read = senses.read(engine);
    const LaneArray& command = read.command;
    EXPECT_EQ(read.command_stop.at(0, 0), tick < 500 ? 0.0f : 1.0f);
    EXPECT_EQ(read.command_stop.at(0, 1), 1.0f);
    EXPECT_EQ(command.at(0, 0), tick < 500 ? 0.3f : 0.0f);
    EXPECT_EQ(command.at(1, 0), tick < 500 ? 0.5f : 0.0f);
    EXPECT_EQ(command.at(0, 1), 0.0f);
  }
}

TEST(Senses, OfTheHeadingErrorIsTheSumOfCommandedTurnsLessTheYaw) {
  const CommandSchedule schedule = turning_left(0.5f);
  FakeEngine engine(1);
  engine.frame().attitude_rad.at(2, 0) = 3.0f;
  Senses senses({.extra = {.heading_error = true}, .models = {}}, engine.sensors(), timestep_s);
  senses.load(0, engine, nullptr, &schedule);
  for (int tick = 0; tick < 900; ++tick) {
    // It turns half as fast as it is told, and for longer.
    const double yaw_rad = 3.0 + 0.0025 * tick, wanted_rad = 3.0 + 0.005 * std::min(tick, 500);
    engine.frame().attitude_rad.at(2, 0) = static_cast<float>(std::remainder(yaw_rad, 2.0 * M_PI));
    EXPECT_NEAR(senses.read(engine).heading_error_rad.at(0, 0),
                std::remainder(wanted_rad - yaw_rad, 2.0 * M_PI), 1e-4);
  }
}

TEST(Senses, OfABlockedRobotTheHeadingIsAheadByNoMoreThanTheLeadAndComesBackAtOnce) {
  for (const float turn_rad_s : {0.5f, -0.5f})
    for (const float yaw_rad : {0.0f, 3.1f, -3.1f}) {
      const CommandSchedule schedule{{{0, {0.3f, turn_rad_s}}, {2000, {0.3f, -turn_rad_s}}}, 0};
      FakeEngine engine(1);
      engine.frame().attitude_rad.at(2, 0) = yaw_rad;
      Senses senses({.extra = {.heading_error = true}, .models = {}, .heading_lead_rad = 1.0f},
                    engine.sensors(), timestep_s);
      senses.load(0, engine, nullptr, &schedule);
      const double side = turn_rad_s > 0.0f ? 1.0 : -1.0;
      for (int tick = 0; tick < 2400; ++tick) {
        const float error_rad = senses.read(engine).heading_error_rad.at(0, 0);
        const double expected_rad =
            tick <= 2000 ? std::min(0.005 * tick, 1.0) : std::max(1.0 - 0.005 * (tick - 2000), -1.0);
        EXPECT_NEAR(side * error_rad, expected_rad, 1e-3) << tick << ": " << turn_rad_s;
      }
    }
}

TEST(Senses, ARobotThatTurnsAsItIsToldFeelsNothingOfTheLead) {
  const CommandSchedule schedule = turning_left(0.5f);
  FakeEngine engine(1);
  const auto error_of = [&](Senses& senses) {
    return std::bit_cast<std::uint32_t>(senses.read(engine).heading_error_rad.at(0, 0));
  };
  Senses within({.extra = {.heading_error = true}, .models = {}, .heading_lead_rad = 0.5f}, engine.sensors(),
                timestep_s),
      without({.extra = {.heading_error = true}, .models = {}}, engine.sensors(), timestep_s);
  within.load(0, engine, nullptr, &schedule);
  without.load(0, engine, nullptr, &schedule);
  for (int tick = 0; tick < 500; ++tick) {
    engine.frame().attitude_rad.at(2, 0) =
        static_cast<float>(std::remainder(0.0051 * tick + 0.2 * std::sin(0.1 * tick), 2.0 * M_PI));
    EXPECT_EQ(error_of(within), error_of(without)) << tick;
  }
}

TEST(Senses, AngleOfAnyNumberOfTurnsIsWrappedToHalfATurn) {
  for (int turns = -20; turns <= 20; ++turns)
    for (const double rest_rad : {-3.1, -1.0, 0.0, 0.5, 3.1})
      EXPECT_NEAR(wrapped_rad(static_cast<float>(2.0 * M_PI * turns + rest_rad)), rest_rad, 2e-5) << turns;
  EXPECT_TRUE(std::isnan(wrapped_rad(std::numeric_limits<float>::infinity())));
}

TEST(Senses, OfTheHeadingErrorStayWithinHalfATurnHoweverFastTheRobotIsToldToTurn) {
  const CommandSchedule schedule = turning_left(90.0f);
  FakeEngine engine(1);
  Senses senses({.extra = {.heading_error = true}, .models = {}}, engine.sensors(), 0.1);
  senses.load(0, engine, nullptr, &schedule);
  for (int tick = 0; tick < 50; ++tick)
    EXPECT_NEAR(senses.read(engine).heading_error_rad.at(0, 0), std::remainder(9.0 * tick, 2.0 * M_PI), 1e-4);
}

}  // namespace
}  // namespace amble::trial
