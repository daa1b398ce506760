#include "amble/controllers/modulated_supg_batch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "amble/controllers/supg_batch.hpp"
#include "amble/core/error.hpp"
#include "amble/core/random.hpp"
#include "tests/controllers/linear_cppn.hpp"
#include "tests/controllers/plain_modulated_leg.hpp"
#include "tests/controllers/supg_substrate.hpp"

namespace amble::controllers {
namespace modulated_supg_test {

constexpr double timestep_s = 0.01;
constexpr int legs = 4, types = 3, joints = legs * types;
const std::vector<std::string> leg_names{"FL", "FR", "BL", "BR"};

SupgJoints all_joints(const robot::RobotSpec& robot) {
  SupgJoints all;
  for (int joint = 0; joint < joints; ++joint) all.of_legs.push_back(joint);
  all.ranges = joint_ranges(robot);
  return all;
}

SupgParameters random_targets(int period, Stream& stream) {
  static const auto ranges = joint_ranges(quadruped());
  SupgParameters parameters(legs, types, period);
  for (int leg = 0; leg < legs; ++leg) {
    parameters.set_offset_ticks(leg,
                                1 + static_cast<int>(stream.below(static_cast<std::uint32_t>(period - 1))));
    for (int timer = SupgParameters::stopped; timer <= period; ++timer)
      for (int type = 0; type < types; ++type)
        parameters.targets_rad(leg, timer)[type] =
            ranges[static_cast<std::size_t>(leg * types + type)].at(stream.uniform());
  }
  return parameters;
}

/// With random gains and rates.
ModulatedParameters random_modulated(int period, int sensors, Stream& stream, int levels = 1) {
  ModulatedParameters parameters(random_targets(period, stream), sensors, sensors * levels);
  Modulation& modulation = parameters.modulation();
  for (int leg = 0; leg < legs; ++leg) {
    for (int s = 0; s < sensors; ++s) modulation.rate(leg, s) = static_cast<float>(stream.uniform(-1.0, 1.0));
    for (int channel = 0; channel < sensors * levels; ++channel)
      for (int timer = 0; timer <= period + 1; ++timer)
        for (int type = 0; type < types; ++type)
          modulation.entry(leg, timer)[(1 + channel) * modulation.width() + type] =
              static_cast<float>(stream.uniform(-0.3, 0.3));
  }
  return parameters;
}

ModulatedSupgs supgs(const SupgSettings& settings) {
  return {settings,
          timestep_s,
          leg_names,
          all_joints(quadruped()),
          leg_sensors(settings.modulation, {}, quadruped(), timestep_s),
          leg_loads(settings.modulation, {}, quadruped(), timestep_s)};
}

robot::SensorFrame frame(int lanes) {
  return {.joint_angle_rad = LaneArray(joints, lanes),
          .touch = LaneArray(legs, lanes),
          .attitude_rad = LaneArray(3, lanes),
          .foot_load_n = LaneArray(legs, lanes)};
}

void move_randomly(robot::SensorFrame& sensors, Stream& stream) {
  for (int lane = 0; lane < sensors.touch.lanes(); ++lane) {
    for (int leg = 0; leg < legs; ++leg)
      if (stream.chance(0.2)) sensors.touch.at(leg, lane) = 1.0f - sensors.touch.at(leg, lane);
    for (int leg = 0; leg < legs; ++leg)
      sensors.foot_load_n.at(leg, lane) = static_cast<float>(stream.uniform(-2.0, 40.0));
    for (int joint = 0; joint < joints; ++joint)
      sensors.joint_angle_rad.at(joint, lane) = static_cast<float>(stream.uniform(-0.9, 0.9));
    for (int axis = 0; axis < 3; ++axis)
      sensors.attitude_rad.at(axis, lane) = static_cast<float>(stream.uniform(-0.7, 0.7));
  }
}

void expect_same_bits(const LaneArray& a, const LaneArray& b) {
  for (int row = 0; row < a.rows(); ++row)
    for (int lane = 0; lane < a.lanes(); ++lane)
      ASSERT_EQ(std::bit_cast<std::uint32_t>(a.at(row, lane)), std::bit_cast<std::uint32_t>(b.at(row, lane)))
          << row << " " << lane;
}

void expect_same_states(const Batch& a, const Batch& b) {
  std::vector<float> one(2 * legs), other(2 * legs);
  for (int lane = 0; lane < a.lanes(); ++lane) {
    a.state(lane, one);
    b.state(lane, other);
    ASSERT_EQ(one, other);
  }
}

std::vector<SupgSettings> switches(int period) {
  std::vector<SupgSettings> all;
  for (const Trigger trigger : {Trigger::edge, Trigger::level, Trigger::none, Trigger::random})
    for (const Offset offset : {Offset::phase, Offset::delay})
      for (const int start : {0, 1})
        for (const Idle idle : {Idle::mid, Idle::hold, Idle::wrap})
          for (const SeamSettings& seam :
               {SeamSettings{}, SeamSettings{.residual_s = 0.03, .filter_s = 0.02}}) {
            SupgSettings& settings = all.emplace_back();
            settings.period_s = period * timestep_s;
            settings.trigger = trigger;
            settings.trigger_debounce_ticks = 2;
            settings.offset = offset;
            settings.start_tick = start;
            settings.idle = idle;
            settings.seam = seam;
          }
  return all;
}

TEST(ModulatedSupg, WithoutGainsIsThePapersToTheBit) {
  constexpr int period = 11, lanes = 17;
  Stream stream(41, Purpose::test);
  for (SupgSettings settings : switches(period)) {
    SupgBatch plain(settings, timestep_s, leg_names, all_joints(quadruped()), random_targets(period, stream),
                    lanes);
    settings.modulation = {.sensors = {"pitch", "angle.knee"}, .rate = 1.0};
    ModulatedSupgBatch modulated(supgs(settings), ModulatedParameters(random_targets(period, stream), 2, 2),
                                 lanes);
    std::vector<std::unique_ptr<ModulatedParameters>> parameters;
    const auto load = [&](int lane) {
      parameters.push_back(std::make_unique<ModulatedParameters>(random_targets(period, stream), 2, 2));
      plain.load(lane, *parameters.back());
      modulated.load(lane, *parameters.back());
    };
    for (int lane = 0; lane < lanes; ++lane) load(lane);
    auto sensors = frame(lanes);
    LaneArray targets(joints, lanes), expected(joints, lanes);
    for (int tick = 0; tick < 60; ++tick) {
      move_randomly(sensors, stream);
      if (stream.chance(0.1)) load(static_cast<int>(stream.below(lanes)));
      plain.step(sensors, expected);
      modulated.step(sensors, targets);
      ASSERT_NO_FATAL_FAILURE(expect_same_bits(targets, expected)) << tick;
      ASSERT_NO_FATAL_FAILURE(expect_same_states(modulated, plain)) << tick;
    }
  }
}

TEST(ModulatedSupg, WithResetZeroKnowsNoTrigger) {
  constexpr int period = 11, lanes = 5;
  Stream stream(42, Purpose::test);
  for (SupgSettings settings : switches(period)) {
    settings.modulation = {.sensors = {"pitch"}, .rate = 1.0, .shape = 1.0, .reset = 0.0};
    ModulatedSupgBatch triggered(supgs(settings), random_modulated(period, 1, stream), lanes);
    settings.trigger = Trigger::none;
    ModulatedSupgBatch open(supgs(settings), random_modulated(period, 1, stream), lanes);
    const ModulatedParameters parameters = random_modulated(period, 1, stream);
    for (int lane = 0; lane < lanes; ++lane) {
      triggered.load(lane, parameters);
      open.load(lane, parameters);
    }
    auto sensors = frame(lanes);
    LaneArray targets(joints, lanes), expected(joints, lanes);
    for (int tick = 0; tick < 60; ++tick) {
      move_randomly(sensors, stream);
      triggered.step(sensors, targets);
      open.step(sensors, expected);
      ASSERT_NO_FATAL_FAILURE(expect_same_bits(targets, expected)) << tick;
    }
  }
}

TEST(ModulatedSupg, EqualsPlainLegsForAllSwitchesAndLaneCounts) {
  constexpr int period = 13;
  Stream stream(43, Purpose::test);
  const auto ranges = joint_ranges(quadruped());
  for (SupgSettings settings : switches(period)) {
    if (settings.seam.smooths() || settings.trigger == Trigger::random) continue;
    settings.modulation = {.sensors = {"pitch", "angle.hip_fb", "touch"},
                           .rate = 1.0,
                           .shape = 1.0,
                           .shape_by = stream.chance(0.5) ? ShapeBy::gain : ShapeBy::reading,
                           .reset = std::vector{1.0, 0.5, 0.25, 0.0}[stream.below(4)],
                           .refractory_ticks = static_cast<int>(stream.below(4)),
                           .load_feedback = stream.chance(0.5) ? 1.5 : 0.0};
    if (stream.chance(0.2)) settings.modulation.rate = 0.0;
    const auto senses = leg_sensors(settings.modulation, {}, quadruped(), timestep_s);
    auto with_loads = settings.modulation;
    with_loads.load_feedback = 1.0;
    const auto loads = leg_loads(with_loads, {}, quadruped(), timestep_s);
    const int levels = settings.modulation.shape_by == ShapeBy::gain ? 1 : 4;
    for (const int lanes : {1, 16, 17}) {
      ModulatedSupgBatch batch(supgs(settings), random_modulated(period, 3, stream, levels), lanes);
      std::vector<std::unique_ptr<ModulatedParameters>> parameters;
      std::vector<std::vector<PlainModulatedLeg>> plain(static_cast<std::size_t>(lanes));
      for (int lane = 0; lane < lanes; ++lane) {
        parameters.push_back(
            std::make_unique<ModulatedParameters>(random_modulated(period, 3, stream, levels)));
        batch.load(lane, *parameters.back());
        for (int leg = 0; leg < legs; ++leg)
          plain[static_cast<std::size_t>(lane)].emplace_back(settings, *parameters.back(), leg);
      }
      auto sensors = frame(lanes);
      LaneArray targets(joints, lanes);
      std::vector<float> state(2 * legs);
      for (int tick = 0; tick < 80; ++tick) {
        move_randomly(sensors, stream);
        batch.step(sensors, targets);
        for (int lane = 0; lane < lanes; ++lane) {
          batch.state(lane, state);
          for (int leg = 0; leg < legs; ++leg) {
            const auto l = static_cast<std::size_t>(leg);
            PlainModulatedLeg& expected = plain[static_cast<std::size_t>(lane)][l];
            std::vector<float> sensed;
            for (const LegSensor& sensor : senses[l])
              sensed.push_back(sensor.sensed(substrate::row_of(sensor.sensor, sensors)[lane]));
            expected.tick(sensors.touch.at(leg, lane) > 0.5f, sensed,
                          loads[l].sensed(sensors.foot_load_n.at(leg, lane)));
            ASSERT_EQ(state[l], static_cast<float>(expected.timer)) << tick;
            ASSERT_EQ(state[legs + l], expected.triggered ? 1.0f : 0.0f);
            for (int type = 0; type < types; ++type)
              ASSERT_EQ(
                  targets.at(leg * types + type, lane),
                  expected.target_rad(type, sensed, ranges[static_cast<std::size_t>(leg * types + type)]));
          }
        }
      }
    }
  }
}

/// Ticks of each of the periods that the first leg makes while it senses a constant.
std::vector<int> periods_with(double rho, int period, int count) {
  SupgSettings settings;
  settings.period_s = period * timestep_s;
  settings.trigger = Trigger::none;
  settings.idle = Idle::wrap;
  settings.modulation = {.sensors = {"touch"}, .rate = 1.0};
  Stream stream(1, Purpose::test);
  ModulatedParameters parameters(random_targets(period, stream), 1, 1);
  for (int leg = 0; leg < legs; ++leg) parameters.modulation().rate(leg, 0) = static_cast<float>(rho);
  ModulatedSupgBatch batch(supgs(settings), parameters, 1);
  batch.load(0, parameters);
  auto sensors = frame(1);
  sensors.touch.set_lane(0, 1.0f);
  LaneArray targets(joints, 1);
  std::vector<float> state(2 * legs);
  std::vector<int> periods;
  float before = -1.0f;
  for (int ticks = 1; static_cast<int>(periods.size()) <= count; ++ticks) {
    batch.step(sensors, targets);
    batch.state(0, state);
    EXPECT_GE(state[0], 0.0f);
    if (state[0] < before) {
      periods.push_back(ticks);
      ticks = 0;
    } else {
      EXPECT_NEAR(state[0] - before, before < 0.0f ? state[0] - before : std::exp2(rho), 1e-4);
    }
    before = state[0];
  }
  periods.erase(periods.begin());  // it began within a period
  return periods;
}

TEST(ModulatedSupg, AConstantSensorGivesThePeriodTimesTwoToTheMinusRho) {
  for (const double rho : {-1.0, -0.7, -0.3, 0.0, 0.2, 0.5, 1.0}) {
    const double expected = 100.0 * std::exp2(-rho);
    const std::vector<int> periods = periods_with(rho, 100, 200);
    double sum = 0.0;
    for (const int period : periods) {
      EXPECT_LE(std::abs(period - expected), 1.0) << rho;  // to the tick
      sum += period;
    }
    EXPECT_NEAR(sum / 200.0, expected, 0.02) << rho;  // and on average within what is left of a tick
    for (const int period : periods)
      EXPECT_TRUE(rho != std::round(rho) || period == static_cast<int>(expected));
  }
}

/// The phase of the first leg after so many ticks under a load that is this share of the robot's weight.
double phase_under(double feedback, float share, int ticks, bool lifted_then) {
  constexpr int period = 200;
  SupgSettings settings;
  settings.period_s = period * timestep_s;
  settings.trigger = Trigger::none;
  settings.idle = Idle::wrap;
  settings.modulation = {.sensors = {}, .load_feedback = feedback};
  Stream stream(1, Purpose::test);
  SupgParameters targets_of_legs = random_targets(period, stream);
  for (int leg = 0; leg < legs; ++leg) targets_of_legs.set_offset_ticks(leg, period / 2);
  const ModulatedParameters parameters(std::move(targets_of_legs), 0, 0);
  ModulatedSupgBatch batch(supgs(settings), parameters, 1);
  batch.load(0, parameters);
  auto sensors = frame(1);
  const float weight_n = 1.0f / leg_loads(settings.modulation, {}, quadruped(), timestep_s)[0].gain;
  LaneArray targets(joints, 1);
  std::vector<float> state(2 * legs);
  sensors.foot_load_n.set_lane(0, share * weight_n);
  for (int tick = 0; tick < ticks; ++tick) batch.step(sensors, targets);
  sensors.foot_load_n.set_lane(0, 0.0f);
  for (int tick = 0; tick < period && lifted_then; ++tick) batch.step(sensors, targets);
  batch.state(0, state);
  return static_cast<double>(state[0]) / period;
}

TEST(ModulatedSupg, ALoadedFootHoldsItsTimerBehindThreeQuartersUntilItIsLifted) {
  for (const double pull : {1.5, 2.0, 10.0}) {
    const double expected = 1.0 - std::acos(1.0 / pull) / (2.0 * std::numbers::pi);  // cos 2πφ = 1/σn
    const double held = phase_under(2.0 * pull, 0.5f, 2000, false);
    EXPECT_NEAR(held, expected, 0.01) << pull;
    EXPECT_EQ(phase_under(2.0 * pull, 0.5f, 3000, false), held) << "it stands";
    EXPECT_NEAR(phase_under(2.0 * pull, 0.5f, 2000, true), held, 1e-6)
        << "and without a load a period is a period";
  }
  EXPECT_NE(phase_under(1.0, 0.5f, 2000, false), phase_under(1.0, 0.5f, 2001, false)) << "half is too little";
}

TEST(ModulatedSupg, ByReadingIsThePatternThatTheCppnSaysForWhatIsSensed) {
  SupgSettings settings;
  settings.period_s = 0.1;
  settings.trigger = Trigger::none;
  settings.idle = Idle::wrap;
  settings.modulation = {
      .sensors = {"pitch", "touch"}, .rate = 0.5, .shape = 1.0, .shape_by = ShapeBy::reading};
  const SupgArchitecture architecture(settings, supg_substrate(), quadruped(), timestep_s);
  EXPECT_EQ(architecture.cppn_inputs(),
            (std::vector<std::string>{"leg", "joint_type", "time", "sensed.pitch", "sensed.touch"}));
  EXPECT_EQ(architecture.cppn_outputs(), (std::vector<std::string>{"pattern", "offset", "rate"}));
  // pattern = 0.1 time + 0.4 pitch − 0.2 touch, rate = 0.5 type + 0.7 time + 0.6 pitch − 0.1 touch.
  const auto decoded = architecture.decode(
      linear_cppn<6, 3>({{{0, 0, 0, 0.1, 0.4, -0.2}, {0.2, 0, 0, 0, 0, 0}, {0, 0, 0.5, 0.7, 0.6, -0.1}}}));
  const Modulation& modulation = dynamic_cast<const ModulatedParameters&>(*decoded).modulation();
  EXPECT_NEAR(modulation.rate(0, 0), 0.5 * 0.6, 1e-6);
  EXPECT_NEAR(modulation.rate(0, 1), 0.5 * -0.1, 1e-6);
  // A linear pattern is linear between its levels, too: what both sensors say adds up.
  const auto batch = architecture.make_batch(1);
  batch->load(0, *decoded);
  auto sensors = frame(1);
  LaneArray targets(joints, 1);
  std::vector<float> state(2 * legs);
  for (const float pitch_rad : {0.0f, 0.25f, 0.1f, -0.3f, -2.0f}) {
    sensors.touch.at(0, 0) = 1.0f;
    sensors.attitude_rad.at(1, 0) = pitch_rad;
    batch->step(sensors, targets);
    batch->state(0, state);
    const double s = std::clamp(pitch_rad / 0.5, -1.0, 1.0);
    const double pattern = 0.1 * static_cast<double>(state[0]) / 10.0 + 0.4 * s - 0.2;
    EXPECT_NEAR(targets.at(0, 0), -0.8 + 0.4 * (pattern + 1.0), 1e-5) << pitch_rad;  // FL knee: −0.8 … 0
  }
}

}  // namespace modulated_supg_test
}  // namespace amble::controllers
