#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "amble/trial/senses.hpp"
#include "tests/experiment/fixture.hpp"

// What controllers sense, engine by engine.
namespace amble::experiment {
namespace {

constexpr int ticks = 100, alike_ticks = 15;

/// Readings by the names of sensors, tick by tick, of a robot that rocks on its legs and is told to turn.
std::map<std::string, std::vector<double>> readings_in(const std::string& engine_name) {
  const Problem problem = small_problem();
  const auto engine = physics::make_engine(
      engine_name, problem.robot, {.timestep_s = problem.trial.timestep_s, .torques = true, .loads = true});
  engine->place(0);
  const trial::CommandSchedule commands{{{0, {0.3f, 0.4f}}, {50, {0.0f, 0.0f}}}, 0};
  robot::ExtraSenses extra;
  for (const substrate::SensorKind& kind : substrate::sensor_kinds())
    extra |= substrate::extra_senses({kind.kind, 0});
  trial::Senses senses({.extra = extra, .models = {}}, engine->sensors(), problem.trial.timestep_s);
  senses.load(0, *engine, nullptr, &commands);
  const int joints = static_cast<int>(problem.robot.joints.size());
  LaneArray targets(joints, engine->lanes());
  std::map<std::string, std::vector<double>> all;
  for (int tick = 0; tick < ticks; ++tick) {
    const robot::SensorFrame& frame = senses.read(*engine);
    for (const substrate::SensorKind& kind : substrate::sensor_kinds()) {
      const bool of_joint = kind.owner == substrate::SensorOwner::joint,
                 of_leg = kind.owner == substrate::SensorOwner::leg;
      const int owners = of_joint ? joints : of_leg ? static_cast<int>(problem.robot.legs.size()) : 1;
      for (int i = 0; i < owners; ++i)
        if (const float* const row = substrate::row_of({kind.kind, i}, frame))
          all[substrate::sensor_name({kind.kind, i}, problem.robot)].push_back(row[0]);
    }
    for (int j = 0; j < joints; ++j)
      targets.at(j, 0) = 0.2f * static_cast<float>(std::sin(0.05 * tick) * std::cos(0.7 * j));
    engine->step(targets);
  }
  return all;
}

/// How far engines may be apart in any of the first ticks, in the sensor's unit. Not there: what contacts
/// make of a stiff robot differs from tick to tick, and its mean counts.
const std::map<std::string, double> alike{{"angle", 0.05},         {"speed", 1.5},      {"roll", 0.005},
                                          {"pitch", 0.005},        {"yaw", 0.005},      {"yaw_rate", 0.2},
                                          {"command_speed", 0},    {"command_turn", 0}, {"command_stop", 0},
                                          {"heading_error", 0.005}};

/// Of a kind of sensor: over all of its sensors and ticks, of numbers without their signs.
double mean_of(const std::map<std::string, std::vector<double>>& all, const std::string& kind) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const auto& [name, readings] : all) {
    if (name.substr(0, name.find('.')) != kind) continue;
    for (const double reading : readings) sum += std::fabs(reading);
    count += readings.size();
  }
  return sum / static_cast<double>(count);
}

TEST(EachSensor, IsThereInEveryEngineChangesAndSaysTheSameOfTheSameRobot) {
  const auto expected = readings_in("ode");
  for (const char* const engine : {"ode", "batch", "mujoco"}) {
    const auto found = readings_in(engine);
    ASSERT_EQ(found.size(), expected.size());
    std::map<std::string, int> changing;
    for (const auto& [name, readings] : found) {
      const std::string kind = name.substr(0, name.find('.'));
      ASSERT_EQ(readings.size(), static_cast<std::size_t>(ticks)) << engine << " " << name;
      const auto [least, most] = std::ranges::minmax(readings);
      EXPECT_TRUE(std::isfinite(least) && std::isfinite(most)) << engine << " " << name;
      changing[kind] += least != most ? 1 : 0;
      if (!alike.contains(kind)) continue;
      for (std::size_t tick = 0; tick < alike_ticks; ++tick)
        EXPECT_NEAR(readings[tick], expected.at(name)[tick], alike.at(kind))
            << engine << " " << name << ", tick " << tick;
    }
    for (const substrate::SensorKind& kind : substrate::sensor_kinds())
      if (kind.owner != substrate::SensorOwner::clock) {
        EXPECT_GT(changing[std::string(kind.name)], 0) << engine << " " << kind.name;
      }
    for (const char* const kind : {"touch", "load", "torque"}) {
      const double mean = mean_of(expected, kind);
      EXPECT_NEAR(mean_of(found, kind), mean, 0.25 * mean) << engine << " " << kind;
    }
  }
}

}  // namespace
}  // namespace amble::experiment
