#include "amble/trial/disturbances.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/trial/fakes.hpp"

namespace amble::trial {
namespace {

/// Two joints and two legs.
robot::SensorFrame frame(int lanes) {
  return {.joint_angle_rad = LaneArray(2, lanes),
          .touch = LaneArray(2, lanes),
          .attitude_rad = LaneArray(3, lanes)};
}

Scenario quiet() {
  Scenario scenario;
  scenario.joint_sensor_rad = {0.0f, 0.0f};
  scenario.attitude_sensor_rad = {0.0f, 0.0f, 0.0f};
  return scenario;
}

TEST(Disturbances, HandTheVerySensorsOnWhileNoLaneIsDisturbed) {
  const auto sensors = frame(2);
  Disturbances disturbances(sensors);
  EXPECT_EQ(&disturbances.read(sensors), &sensors);
  const auto scenario = quiet();
  disturbances.load(1, &scenario);
  EXPECT_NE(&disturbances.read(sensors), &sensors);
  disturbances.load(1, nullptr);
  EXPECT_EQ(&disturbances.read(sensors), &sensors);
}

TEST(Disturbances, OffsetWhatOneLaneReadsAndLeaveTheOthersAlone) {
  auto sensors = frame(2);
  sensors.joint_angle_rad.at(1, 1) = 0.5f;
  sensors.joint_angle_rad.at(1, 0) = -0.0f;
  auto scenario = quiet();
  scenario.joint_sensor_rad = {0.25f, -0.25f};
  scenario.attitude_sensor_rad = {0.5f, 1.0f, 1.5f};
  Disturbances disturbances(sensors);
  disturbances.load(1, &scenario);
  for (int tick = 0; tick < 3; ++tick) {
    const auto& read = disturbances.read(sensors);
    EXPECT_EQ(read.joint_angle_rad.at(0, 1), 0.25f);
    EXPECT_EQ(read.joint_angle_rad.at(1, 1), 0.25f);
    EXPECT_EQ(read.attitude_rad.at(2, 1), 1.5f);
    EXPECT_EQ(read.joint_angle_rad.at(0, 0), 0.0f);
    EXPECT_EQ(read.attitude_rad.at(0, 0), 0.0f);
    EXPECT_TRUE(std::signbit(read.joint_angle_rad.at(1, 0))) << "to the bit";
  }
}

TEST(Disturbances, LetNumbFeetReadZeroFromTheirStepOnInEveryTrialWhateverFlips) {
  auto sensors = frame(2);
  for (int lane = 0; lane < 2; ++lane) sensors.touch.at(0, lane) = sensors.touch.at(1, lane) = 1.0f;
  auto scenario = quiet();
  scenario.touch_flips = {{.step = 2, .leg = 0}, {.step = 4, .leg = 1}};
  Disturbances disturbances(sensors, {{.leg = 1, .first_step = 3}});
  disturbances.load(0, nullptr);
  disturbances.load(1, &scenario);
  const auto expect = [&](int step) {
    const auto& read = disturbances.read(sensors);
    const float numb = step < 3 ? 1.0f : 0.0f;
    EXPECT_EQ(read.touch.at(0, 0), 1.0f) << step;
    EXPECT_EQ(read.touch.at(1, 0), numb) << step;
    EXPECT_EQ(read.touch.at(0, 1), step == 2 ? 0.0f : 1.0f) << step;
    EXPECT_EQ(read.touch.at(1, 1), numb) << step;
  };
  for (int step = 1; step <= 6; ++step) expect(step);
  disturbances.load(0, nullptr);
  disturbances.load(1, &scenario);
  expect(1);
}

TEST(Disturbances, FlipATouchInItsStepOnly) {
  auto sensors = frame(1);
  sensors.touch.at(0, 0) = 1.0f;
  auto scenario = quiet();
  scenario.touch_flips = {{.step = 2, .leg = 0}, {.step = 2, .leg = 1}, {.step = 4, .leg = 1}};
  Disturbances disturbances(sensors);
  for (int round = 0; round < 2; ++round) {
    disturbances.load(0, &scenario);  // begins anew
    std::vector<std::pair<float, float>> seen;
    for (int step = 1; step <= 5; ++step) {
      const auto& read = disturbances.read(sensors);
      seen.emplace_back(read.touch.at(0, 0), read.touch.at(1, 0));
    }
    EXPECT_EQ(seen, (std::vector<std::pair<float, float>>{{1, 0}, {0, 1}, {1, 0}, {1, 1}, {1, 0}}));
  }
}

TEST(Disturbances, DelayTargetsByTheLatencyAndHoldZeroUntilThen) {
  for (const int latency : {0, 1, 2, 5}) {
    const auto sensors = frame(2);
    auto scenario = quiet();
    scenario.latency_ticks = latency;
    FakeEngine engine(2);
    Disturbances disturbances(sensors);
    disturbances.load(1, &scenario);
    LaneArray targets_rad(2, 2);
    for (int tick = 1; tick <= 20; ++tick) {
      for (int j = 0; j < 2; ++j)
        for (int lane = 0; lane < 2; ++lane) targets_rad.at(j, lane) = static_cast<float>(tick * (j + 1));
      disturbances.read(sensors);
      disturbances.act(targets_rad, engine);
      const int arrived = std::max(0, tick - latency);
      for (int j = 0; j < 2; ++j) {
        EXPECT_EQ(targets_rad.at(j, 0), static_cast<float>(tick * (j + 1))) << "no scenario, no delay";
        EXPECT_EQ(targets_rad.at(j, 1), static_cast<float>(arrived * (j + 1))) << latency << ' ' << tick;
      }
    }
  }
}

TEST(Disturbances, PushInTheirSteps) {
  const auto sensors = frame(1);
  auto scenario = quiet();
  scenario.pushes = {{.step = 1, .impulse_n_s = {1, 0, 0}},
                     {.step = 3, .impulse_n_s = {0, 10, 0}},
                     {.step = 3, .impulse_n_s = {0, 0, 100}}};
  FakeEngine engine(1);
  engine.place(0);
  Disturbances disturbances(sensors);
  disturbances.load(0, &scenario);
  LaneArray targets_rad(2, 1);
  std::vector<Vec3> pushed;
  for (int step = 1; step <= 4; ++step) {
    disturbances.read(sensors);
    disturbances.act(targets_rad, engine);
    pushed.push_back(engine.pushed_n_s);
  }
  EXPECT_EQ(pushed, (std::vector<Vec3>{{1, 0, 0}, {1, 0, 0}, {1, 10, 100}, {1, 10, 100}}));
}

}  // namespace
}  // namespace amble::trial
