#include "amble/controllers/supg_seam.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <vector>

#include "amble/controllers/supg.hpp"
#include "amble/core/random.hpp"
#include "amble/io/json_file.hpp"
#include "tests/controllers/supg_substrate.hpp"

namespace amble::controllers {
namespace supg_seam_test {

constexpr double timestep_s = 0.01;
constexpr int legs = 4, types = 3, joints = legs * types, period = 12;

SupgParameters random_parameters(const robot::RobotSpec& robot, Stream& stream) {
  SupgParameters parameters(legs, types, period);
  const auto ranges = joint_ranges(robot);
  for (int leg = 0; leg < legs; ++leg) {
    parameters.set_offset_ticks(leg, 1 + static_cast<int>(stream.below(period - 1)));
    for (int timer = SupgParameters::stopped; timer <= period; ++timer)
      for (int type = 0; type < types; ++type)
        parameters.targets_rad(leg, timer)[type] =
            ranges[static_cast<std::size_t>(leg * types + type)].at(stream.uniform());
  }
  return parameters;
}

/// One joint's targets, number by number.
class PlainSeam {
 public:
  PlainSeam(const SeamSettings& settings, double lower_rad, double upper_rad)
      : settings_(settings),
        lower_rad_(static_cast<float>(lower_rad)),
        upper_rad_(static_cast<float>(upper_rad)),
        factors_(settings, timestep_s) {}

  /// `continued_rad`: the pattern as it would be without a jump. The first call begins at rest there.
  float next(float continued_rad, float present_rad, bool jumped) {
    float y = present_rad;
    if (settings_.residual_s > 0.0) {
      const float left = no_dust(factors_.residual_decay * residual_);
      y = std::clamp(continued_rad + left, lower_rad_, upper_rad_);
      residual_ = jumped ? y - present_rad : left;
    }
    if (settings_.filter_s <= 0.0) return y;
    if (!begun_) stages_.assign(static_cast<std::size_t>(settings_.filter_order), present_rad);
    begun_ = true;
    for (float& z : stages_) y = z = no_dust(z + factors_.filter_share * (y - z));
    return std::clamp(y, lower_rad_, upper_rad_);
  }
  float residual() const { return residual_; }

 private:
  static float no_dust(float value) { return std::fabs(value) > 1e-9f ? value : 0.0f; }

  SeamSettings settings_;
  float lower_rad_, upper_rad_;
  SeamFactors factors_;
  float residual_ = 0.0f;
  bool begun_ = false;
  std::vector<float> stages_;
};

/// A smoothed batch of one kind of settings beside one that jumps, which shows the timers, and plain seams.
class Walk {
 public:
  Walk(const SupgSettings& settings, int lanes, Stream& stream)
      : settings_(settings),
        robot_(quadruped()),
        architecture_(settings, supg_substrate(), robot_, timestep_s),
        batch_(architecture_.make_batch(lanes)),
        sensors_{LaneArray(joints, lanes), LaneArray(legs, lanes), LaneArray(3, lanes)},
        targets_(joints, lanes),
        before_(joints, lanes),
        parameters_(static_cast<std::size_t>(lanes)),
        seams_(static_cast<std::size_t>(lanes)),
        timers_(static_cast<std::size_t>(lanes)),
        stream_(stream) {
    for (int lane = 0; lane < lanes; ++lane) load(lane);
  }

  void load(int lane) {
    const auto i = static_cast<std::size_t>(lane);
    parameters_[i] = std::make_unique<SupgParameters>(random_parameters(robot_, stream_));
    batch_->load(lane, *parameters_[i]);
    seams_[i].clear();
    for (const robot::Joint& joint : robot_.joints)
      seams_[i].emplace_back(settings_.seam, joint.lower_rad, joint.upper_rad);
    timers_[i].assign(legs, -2);  // not begun
  }

  void step() {
    for (int lane = 0; lane < batch_->lanes(); ++lane)
      for (int leg = 0; leg < legs; ++leg)
        if (stream_.chance(0.2)) sensors_.touch.at(leg, lane) = 1.0f - sensors_.touch.at(leg, lane);
    before_ = targets_;
    batch_->step(sensors_, targets_);
    for (int lane = 0; lane < batch_->lanes(); ++lane) compare(lane);
  }

  int jumps() const { return jumps_; }

 private:
  int continued(int before, int now) const {
    if (before == -2) return settings_.offset == Offset::phase ? now : SupgParameters::stopped;
    return before == SupgParameters::stopped ? before : std::min(before + 1, period);
  }

  void compare(int lane) {
    const auto i = static_cast<std::size_t>(lane);
    std::vector<float> state(2 * legs);
    batch_->state(lane, state);
    for (int leg = 0; leg < legs; ++leg) {
      const auto l = static_cast<std::size_t>(leg);
      const int now = static_cast<int>(state[l]), without = continued(timers_[i][l], now);
      const bool begins = timers_[i][l] == -2;
      timers_[i][l] = now;
      jumps_ += now != without;
      for (int type = 0; type < types; ++type) {
        const int joint = leg * types + type;
        PlainSeam& seam = seams_[i][static_cast<std::size_t>(joint)];
        const float residual_before = std::fabs(seam.residual());
        const float expected = seam.next(parameters_[i]->targets_rad(leg, without)[type],
                                         parameters_[i]->targets_rad(leg, now)[type], now != without);
        ASSERT_EQ(std::bit_cast<std::uint32_t>(targets_.at(joint, lane)),
                  std::bit_cast<std::uint32_t>(expected));
        if (!begins) check_bound(lane, leg, type, residual_before);
      }
    }
  }

  /// |Δy| ≤ max |ΔP| + |r| h/τ, to rounding; a filter makes no step longer.
  void check_bound(int lane, int leg, int type, float residual_rad) {
    if (settings_.seam.residual_s <= 0.0 || settings_.seam.filter_s > 0.0) return;
    const SupgParameters& parameters = *parameters_[static_cast<std::size_t>(lane)];
    float most = 0.0f;
    for (int tick = 0; tick < period; ++tick)
      most = std::max(most, std::fabs(parameters.targets_rad(leg, tick + 1)[type] -
                                      parameters.targets_rad(leg, tick)[type]));
    const int joint = leg * types + type;
    const double moved = std::fabs(static_cast<double>(targets_.at(joint, lane)) - before_.at(joint, lane));
    ASSERT_LE(moved, most + residual_rad * timestep_s / settings_.seam.residual_s + 2e-6);
  }

  SupgSettings settings_;
  robot::RobotSpec robot_;
  SupgArchitecture architecture_;
  std::unique_ptr<Batch> batch_;
  robot::SensorFrame sensors_;
  LaneArray targets_, before_;
  std::vector<std::unique_ptr<SupgParameters>> parameters_;
  std::vector<std::vector<PlainSeam>> seams_;
  std::vector<std::vector<int>> timers_;
  Stream& stream_;
  int jumps_ = 0;
};

std::vector<SeamSettings> smoothing_seams() {
  return {{.residual_s = 0.02},
          {.residual_s = 0.1},
          {.filter_s = 0.05, .filter_order = 1},
          {.filter_s = 0.03, .filter_order = 2},
          {.residual_s = 0.05, .filter_s = 0.02, .filter_order = 2}};
}

TEST(SupgSeam, EqualsPlainSeamsWithinTheBoundForAllSwitchesAndLaneCounts) {
  Stream stream(32, Purpose::test);
  for (const SeamSettings& seam : smoothing_seams())
    for (const Trigger trigger : {Trigger::edge, Trigger::level, Trigger::none})
      for (const Offset offset : {Offset::phase, Offset::delay})
        for (const Idle idle : {Idle::mid, Idle::hold, Idle::wrap})
          for (const int lanes : {1, 16, 17}) {
            SupgSettings settings;
            settings.period_s = period * timestep_s;
            settings.trigger = trigger;
            settings.offset = offset;
            settings.idle = idle;
            settings.start_tick = lanes % 2;
            settings.seam = seam;
            Walk walk(settings, lanes, stream);
            for (int tick = 0; tick < 60; ++tick) {
              if (stream.chance(0.05))
                walk.load(static_cast<int>(stream.below(static_cast<std::uint32_t>(lanes))));
              ASSERT_NO_FATAL_FAILURE(walk.step()) << lanes << " lanes, tick " << tick;
            }
            ASSERT_TRUE(trigger != Trigger::edge || walk.jumps() > 0);
          }
}

/// A batch of one lane with the front left knee's pattern, all others in the middle.
struct OneJoint {
  explicit OneJoint(const SeamSettings& seam, const std::vector<float>& pattern_rad, Idle idle = Idle::wrap)
      : parameters(legs, types, static_cast<int>(pattern_rad.size()) - 1) {
    SupgSettings settings;
    settings.period_s = parameters.period_ticks() * timestep_s;
    settings.trigger = Trigger::none;
    settings.idle = idle;
    settings.seam = seam;
    for (int leg = 0; leg < legs; ++leg) parameters.set_offset_ticks(leg, 1);
    for (int tick = 0; tick <= parameters.period_ticks(); ++tick)
      parameters.targets_rad(0, tick)[0] = pattern_rad[static_cast<std::size_t>(tick)];
    batch = SupgArchitecture(settings, supg_substrate(), quadruped(), timestep_s).make_batch(1);
    batch->load(0, parameters);
  }
  double next() {
    const robot::SensorFrame sensors{LaneArray(joints, 1), LaneArray(legs, 1), LaneArray(3, 1)};
    batch->step(sensors, targets);
    return targets.at(0, 0);
  }

  SupgParameters parameters;
  std::unique_ptr<Batch> batch;
  LaneArray targets{joints, 1};
};

TEST(SupgSeam, AJumpFadesExponentially) {
  // A period of 50 ticks at −0.2 rad whose last entry, where it ends, is −0.6: at the end the target goes
  // there, and fades from there to −0.2.
  std::vector<float> pattern(51, -0.2f);
  pattern.back() = -0.6f;
  OneJoint joint({.residual_s = 0.05}, pattern);
  // Tick 1 has timer 2, so tick 49 has timer 0 again.
  for (int tick = 1; tick < 49; ++tick) ASSERT_FLOAT_EQ(static_cast<float>(joint.next()), -0.2f) << tick;
  for (int age = 0; age < 40; ++age)
    EXPECT_NEAR(joint.next(), -0.2 - 0.4 * std::exp(-age * timestep_s / 0.05), 1e-6) << age;
}

TEST(SupgSeam, APatternThatEndsWhereItBeganIsNotChanged) {
  std::vector<float> pattern(41);
  for (int tick = 0; tick < 41; ++tick)
    pattern[static_cast<std::size_t>(tick)] =
        -0.4f + 0.3f * static_cast<float>(std::sin(2.0 * 3.14159265358979 * (tick % 40) / 40.0));
  OneJoint smoothed({.residual_s = 0.05}, pattern), plain({}, pattern);
  for (int tick = 0; tick < 200; ++tick) ASSERT_EQ(smoothed.next(), plain.next());
}

TEST(SupgSeam, FiltersAnswerAStepAsTheirOrderSays) {
  // −0.4 rad (mid-range) while stopped after the first 2 ticks at −0.8: a step of 0.4.
  std::vector<float> pattern(4, -0.8f);
  for (const int order : {1, 2}) {
    OneJoint joint({.filter_s = 0.04, .filter_order = order}, pattern, Idle::mid);
    // From the stop on timers are −1, and blank parameters have 0 there: the step leads to 0 rad.
    ASSERT_FLOAT_EQ(static_cast<float>(joint.next()), -0.8f);
    for (int n = 1; n < 60; ++n) {
      const double left = std::exp(-n * timestep_s / 0.04), share = 1.0 - std::exp(-timestep_s / 0.04);
      const double expected = order == 1 ? -0.8 * left : -0.8 * left * (1.0 + n * share);
      EXPECT_NEAR(joint.next(), expected, 2e-6) << order << " " << n;
    }
  }
}

/// The front left knee's pattern at a timer that need not be whole.
double pattern_at(const SupgParameters& parameters, float timer) {
  const int whole = static_cast<int>(timer), next = std::min(whole + 1, parameters.period_ticks());
  const double a = parameters.targets_rad(0, whole)[0], b = parameters.targets_rad(0, next)[0];
  return a + (static_cast<double>(timer) - whole) * (b - a);
}

TEST(SupgSeam, BoundsStepsOfTargetsAlsoWhereTimersGrowFaster) {
  // |Δy| ≤ growth × max |ΔP| + |r| h/τ: a timer grows by up to two ticks, r is what parts target and pattern.
  Stream stream(33, Purpose::test);
  for (const double rho : {-1.0, 0.3, 1.0})
    for (const double reset : {1.0, 0.5}) {
      constexpr double residual_s = 0.05;
      SupgSettings settings;
      settings.period_s = period * timestep_s;
      settings.idle = Idle::wrap;
      settings.seam = {.residual_s = residual_s};
      settings.modulation = {.sensors = {"pitch"}, .rate = 1.0, .reset = reset};
      ModulatedParameters parameters(random_parameters(quadruped(), stream), 1, 1);
      for (int leg = 0; leg < legs; ++leg) parameters.modulation().rate(leg, 0) = static_cast<float>(rho);
      const auto batch = SupgArchitecture(settings, supg_substrate(), quadruped(), timestep_s).make_batch(1);
      batch->load(0, parameters);
      double most = 0.0, residual = 0.0, before = 0.0;
      for (int tick = 0; tick < period; ++tick)
        most = std::max(most, std::fabs(static_cast<double>(parameters.targets_rad(0, tick + 1)[0]) -
                                        parameters.targets_rad(0, tick)[0]));
      robot::SensorFrame sensors{LaneArray(joints, 1), LaneArray(legs, 1), LaneArray(3, 1)};
      sensors.attitude_rad.at(1, 0) = 0.5f;
      LaneArray targets(joints, 1);
      std::vector<float> state(2 * legs);
      int triggers = 0;
      for (int tick = 0; tick < 2000; ++tick) {
        sensors.touch.at(0, 0) = stream.chance(0.1) ? 1.0f : 0.0f;
        batch->step(sensors, targets);
        batch->state(0, state);
        const double target = targets.at(0, 0), step = std::fabs(target - before);
        if (tick > 0) {
          ASSERT_LE(step, std::exp2(rho) * most + residual * timestep_s / residual_s + 1e-4) << tick;
        }
        residual = std::fabs(target - pattern_at(parameters, state[0]));
        before = target;
        triggers += state[legs] > 0.5f ? 1 : 0;
      }
      EXPECT_GT(triggers, 50) << rho;
    }
}

TEST(SupgSeam, IsLeftOutOfJsonAtItsDefaultsAndReadBackElse) {
  SupgSettings settings;
  EXPECT_FALSE(io::settings_to_json(settings).contains("seam"));
  settings.seam = {.time = substrate::TimeInputs::circle, .detrend = true, .residual_s = 0.05};
  const io::Json json = io::settings_to_json(settings);
  EXPECT_EQ(json["seam"].dump(),
            R"({"time":"circle","detrend":true,"residual_s":0.05,"filter_s":0.0,"filter_order":2})");
  EXPECT_EQ(io::settings_from_json<SupgSettings>(io::JsonView(json, "x")).seam, settings.seam);
  EXPECT_EQ(
      io::settings_from_json<SupgSettings>(io::JsonView(io::settings_to_json(SupgSettings()), "x")).seam,
      SeamSettings());
}

}  // namespace supg_seam_test
}  // namespace amble::controllers
