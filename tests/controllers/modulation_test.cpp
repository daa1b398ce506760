#include "amble/controllers/modulation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "amble/controllers/modulated_supg_batch.hpp"
#include "amble/controllers/supg.hpp"
#include "amble/core/error.hpp"
#include "tests/controllers/linear_cppn.hpp"
#include "tests/controllers/supg_substrate.hpp"

namespace amble::controllers {
namespace modulation_test {

constexpr double timestep_s = 0.01;

TEST(Modulation, ATriggerMovesATimerTheShorterWayRound) {
  const std::int32_t one = parts_per_tick, period = 100 * one, start = one;
  EXPECT_EQ(reset_timer(30 * one, start, period, 32768), start);
  EXPECT_EQ(reset_timer(80 * one + 7, start, period, 32768), start);
  EXPECT_EQ(reset_timer(-1, start, period, 1), start);
  EXPECT_EQ(reset_timer(-1, start, period, 0), -1);
  EXPECT_EQ(reset_timer(41 * one, start, period, 16384), 21 * one);  // half of 40 back
  EXPECT_EQ(reset_timer(81 * one, start, period, 16384), 91 * one);  // half of 20 on
  EXPECT_EQ(reset_timer(99 * one, start, period, 24576),
            0 + one / 2);                                       // three quarters of 2 on, over the end
  EXPECT_EQ(reset_timer(period, start, period, 32768), start);  // one that is held at the end
  for (std::int32_t timer = 0; timer <= period; timer += one / 2) {
    EXPECT_EQ(reset_timer(timer, start, period, 32768), start) << timer;
    EXPECT_EQ(reset_timer(timer, start, period, 0), timer);
    const std::int32_t next = reset_timer(timer, start, period, 12345);
    EXPECT_TRUE(next >= 0 && next < period);
  }
}

TEST(Modulation, GrowsByPowersOfTwoWithinHalfAPart) {
  for (int i = -1000; i <= 1000; ++i) {
    const float rho = static_cast<float>(i) / 1000.0f;
    EXPECT_LE(std::fabs(advance_parts(rho) - 16384.0 * std::exp2(static_cast<double>(rho))), 0.55) << rho;
  }
  EXPECT_EQ(advance_parts(-1.0f), 8192);
  EXPECT_EQ(advance_parts(0.0f), 16384);
  EXPECT_EQ(advance_parts(1.0f), 32768);
}

TEST(Modulation, DecodesGainsAndRatesAsComputedByHand) {
  SupgSettings settings;
  settings.period_s = 0.1;
  settings.modulation = {.sensors = {"pitch", "touch"}, .rate = 0.5, .shape = 0.8};
  const SupgArchitecture architecture(settings, supg_substrate(), quadruped(), timestep_s);
  EXPECT_EQ(architecture.cppn_inputs(), (std::vector<std::string>{"leg", "joint_type", "time", "sensor"}));
  EXPECT_EQ(architecture.cppn_outputs(), (std::vector<std::string>{"pattern", "offset", "gain", "rate"}));
  // gain = 0.1 + 0.2 type + 0.3 time + 0.4 sensor, rate = 10 leg + 0.5 type + 0.7 time + 0.6 sensor; sensors
  // ½, 1.
  const auto decoded = architecture.decode(linear_cppn<5, 4>(
      {{{0.1, 0, 0, 0.2, 9.0}, {0.2, 0, 0, 0, 0}, {0.1, 0, 0.2, 0.3, 0.4}, {0.0, 10.0, 0.5, 0.7, 0.6}}}));
  const auto& parameters = dynamic_cast<const ModulatedParameters&>(*decoded);
  const Modulation& modulation = parameters.modulation();
  for (int tick = 0; tick <= 10; ++tick)
    for (int s = 0; s < 2; ++s) {
      const double sensor = (s + 1) / 2.0, time = tick / 10.0;
      // FL knee has type −1 and a range of 0.8 rad, BR hip_io type 1 and 0.4 rad.
      EXPECT_NEAR(modulation.entry(0, tick)[(1 + s) * 4], 0.8 * 0.4 * (0.1 - 0.2 + 0.3 * time + 0.4 * sensor),
                  1e-6);
      EXPECT_NEAR(modulation.entry(3, tick)[(1 + s) * 4 + 2],
                  0.8 * 0.2 * (0.1 + 0.2 + 0.3 * time + 0.4 * sensor), 1e-6);
    }
  // Leg FL is at −0.02.
  EXPECT_NEAR(modulation.rate(0, 0), 0.5 * (-0.2 + 0.3), 1e-6);
  EXPECT_NEAR(modulation.rate(0, 1), 0.5 * (-0.2 + 0.6), 1e-6);
  // The pattern knows nothing of sensors: 0.1 + 0.2 time.
  EXPECT_NEAR(parameters.targets_rad(0, 5)[0], -0.8 + 0.4 * (1.2), 1e-6);
}

TEST(Modulation, WeightsOfLevelsAreOneThereAndAddUpToOneAboutHalfAUnit) {
  for (const float at : reading_levels)
    for (const float level : reading_levels) EXPECT_EQ(weight_of_level(at, level), at == level ? 1.0f : 0.0f);
  for (const float level : reading_levels) EXPECT_EQ(weight_of_level(0.0f, level), 0.0f);
  EXPECT_FLOAT_EQ(weight_of_level(0.75f, 0.5f), 0.5f);
  EXPECT_FLOAT_EQ(weight_of_level(0.75f, 1.0f), 0.5f);
  EXPECT_FLOAT_EQ(weight_of_level(-0.1f, -0.5f), 0.2f);
}

TEST(Modulation, ScalesSensorsToAboutOne) {
  ModulationSettings settings{.sensors = {"angle.knee", "pitch", "touch"}};
  const auto sensors =
      leg_sensors(settings, {.sensors = {{.of = "pitch", .scale = 2.0}}}, quadruped(), timestep_s);
  EXPECT_NEAR(sensors[0][0].sensed(-0.8f), -1.0, 1e-6);  // front knee: −0.8 … 0
  EXPECT_NEAR(sensors[0][0].sensed(-0.4f), 0.0, 1e-6);
  EXPECT_NEAR(sensors[2][0].sensed(0.6f), 0.5, 1e-6);  // hind knee: 0 … 0.8
  EXPECT_NEAR(sensors[1][1].sensed(0.1f), 0.4, 1e-6);  // half a radian is 1, twice
  EXPECT_EQ(sensors[1][1].sensed(3.0f), 1.0f);
  EXPECT_EQ(sensors[1][1].sensed(std::nanf("")), -1.0f);
  EXPECT_EQ(sensors[3][2].sensed(1.0f), 1.0f);
}

std::string refusal(const std::vector<std::string>& sensors) {
  try {
    leg_sensors({.sensors = sensors}, {}, quadruped(), timestep_s);
  } catch (const SettingError& error) {
    return error.what();
  }
  return "none";
}

TEST(Modulation, RefusesSensorsThatThereAreNot) {
  EXPECT_EQ(
      refusal({"pitch", "smell"}),
      "controller.supg.modulation.sensors[1] = \"smell\": expected angle.TYPE, touch, load, speed.TYPE, "
      "torque.TYPE, "
      "roll, pitch, yaw, yaw_rate, command_speed, command_turn, command_stop, heading_error");
  EXPECT_EQ(refusal({"angle.elbow"}),
            "controller.supg.modulation.sensors[0] = \"angle.elbow\": the robot has no joint type elbow; "
            "expected knee, hip_fb, hip_io");
  EXPECT_EQ(refusal({"pitch", "pitch"}), "controller.supg.modulation.sensors[1] = \"pitch\" is there twice");
  EXPECT_NE(refusal({"angle"}), "none");
  EXPECT_NE(refusal({"sine"}), "none");
  EXPECT_NE(refusal({"touch.FL"}), "none");
}
}  // namespace modulation_test
}  // namespace amble::controllers
