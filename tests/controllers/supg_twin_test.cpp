#include <gtest/gtest.h>

#include <bit>
#include <memory>

#include "amble/controllers/supg.hpp"
#include "amble/core/random.hpp"
#include "tests/controllers/supg_substrate.hpp"

namespace amble::controllers {
namespace supg_twin_test {

constexpr double timestep_s = 0.01;
constexpr int legs = 4, types = 3, period = 9;

/// The timer of one leg, told step by step.
class PlainTimer {
 public:
  PlainTimer(const SupgSettings& settings, int leg, int offset_ticks)
      : settings_(settings), leg_(leg), offset_ticks_(offset_ticks) {}

  bool triggered() const { return triggered_; }
  int timer() const { return timer_; }

  void tick(bool touching) {
    ++tick_;
    triggered_ = false;
    const int first_tick = settings_.offset == Offset::phase ? 1 : offset_ticks_ + 1;
    if (tick_ == first_tick) {
      timer_ = settings_.offset == Offset::phase ? offset_ticks_ : settings_.start_tick;
      if (settings_.offset == Offset::phase) go_on();
    } else if (tick_ > first_tick) {
      triggered_ = is_trigger(touching);
      if (triggered_) {
        timer_ = settings_.start_tick;
      } else if (timer_ != SupgParameters::stopped) {
        go_on();
      }
    }
    up_for_ = touching ? 0 : up_for_ + 1;
  }

 private:
  bool is_trigger(bool touching) const {
    if (settings_.trigger == Trigger::none) return false;
    if (settings_.trigger == Trigger::random) return is_drawn();
    if (!touching) return false;
    return settings_.trigger == Trigger::level || up_for_ >= settings_.trigger_debounce_ticks;
  }
  /// Whether this tick is a sum of gaps, added up from the first on.
  bool is_drawn() const {
    int at = 0;
    for (std::uint32_t number = 0; at < tick_; ++number) {
      Stream stream(1, Purpose::random_triggers, number, static_cast<std::uint32_t>(leg_));
      at += period - period / 2 + static_cast<int>(stream.below(2 * (period / 2) + 1));
    }
    return at == tick_;
  }
  void go_on() {
    if (timer_ < period) ++timer_;
    if (timer_ < period) return;
    if (settings_.idle == Idle::mid) timer_ = SupgParameters::stopped;
    if (settings_.idle == Idle::wrap) timer_ = 0;
  }

  SupgSettings settings_;
  int leg_;
  int offset_ticks_;
  int tick_ = 0, timer_ = SupgParameters::stopped, up_for_ = 0;
  bool triggered_ = false;
};

SupgParameters random_parameters(Stream& stream) {
  SupgParameters parameters(legs, types, period);
  for (int leg = 0; leg < legs; ++leg) {
    parameters.set_offset_ticks(leg, 1 + static_cast<int>(stream.below(period - 1)));
    for (int timer = SupgParameters::stopped; timer <= period; ++timer)
      for (int type = 0; type < types; ++type)
        parameters.targets_rad(leg, timer)[type] = static_cast<float>(stream.uniform(-1.0, 1.0));
  }
  return parameters;
}

/// A batch beside one plain timer per leg and lane.
class Pair {
 public:
  Pair(const SupgSettings& settings, int lanes, Stream& stream)
      : settings_(settings),
        architecture_(settings, supg_substrate(), quadruped(), timestep_s),
        batch_(architecture_.make_batch(lanes)),
        sensors_{LaneArray(legs * types, lanes), LaneArray(legs, lanes), LaneArray(3, lanes)},
        targets_(legs * types, lanes),
        parameters_(static_cast<std::size_t>(lanes)),
        timers_(static_cast<std::size_t>(lanes)),
        stream_(stream) {
    for (int lane = 0; lane < lanes; ++lane) load(lane);
  }

  void load(int lane) {
    const auto i = static_cast<std::size_t>(lane);
    parameters_[i] = std::make_unique<SupgParameters>(random_parameters(stream_));
    batch_->load(lane, *parameters_[i]);
    timers_[i].clear();
    for (int leg = 0; leg < legs; ++leg)
      timers_[i].emplace_back(settings_, leg, parameters_[i]->offset_ticks(leg));
  }

  void step_and_compare() {
    for (int lane = 0; lane < batch_->lanes(); ++lane)
      for (int leg = 0; leg < legs; ++leg)
        if (stream_.chance(0.3)) sensors_.touch.at(leg, lane) = 1.0f - sensors_.touch.at(leg, lane);
    batch_->step(sensors_, targets_);
    for (int lane = 0; lane < batch_->lanes(); ++lane) compare(lane);
  }

 private:
  void compare(int lane) {
    std::vector<float> state(2 * legs);
    batch_->state(lane, state);
    for (int leg = 0; leg < legs; ++leg) {
      const auto l = static_cast<std::size_t>(leg);
      PlainTimer& plain = timers_[static_cast<std::size_t>(lane)][l];
      plain.tick(sensors_.touch.at(leg, lane) == 1.0f);
      ASSERT_EQ(state[l], static_cast<float>(plain.timer()));
      ASSERT_EQ(state[legs + l], plain.triggered() ? 1.0f : 0.0f);
      for (int type = 0; type < types; ++type) {
        const float expected =
            parameters_[static_cast<std::size_t>(lane)]->targets_rad(leg, plain.timer())[type];
        ASSERT_EQ(std::bit_cast<std::uint32_t>(targets_.at(leg * types + type, lane)),
                  std::bit_cast<std::uint32_t>(expected));
      }
    }
  }

  SupgSettings settings_;
  SupgArchitecture architecture_;
  std::unique_ptr<Batch> batch_;
  robot::SensorFrame sensors_;
  LaneArray targets_;
  std::vector<std::unique_ptr<SupgParameters>> parameters_;
  std::vector<std::vector<PlainTimer>> timers_;
  Stream& stream_;
};

std::vector<SupgSettings> all_switches() {
  std::vector<SupgSettings> all;
  for (const Trigger trigger : {Trigger::edge, Trigger::level, Trigger::none, Trigger::random})
    for (const int debounce : {1, 2, 4})
      for (const Offset offset : {Offset::phase, Offset::delay})
        for (const int start : {0, 1})
          for (const Idle idle : {Idle::mid, Idle::hold, Idle::wrap}) {
            SupgSettings& settings = all.emplace_back();
            settings.period_s = period * timestep_s;
            settings.trigger = trigger;
            settings.trigger_debounce_ticks = debounce;
            settings.offset = offset;
            settings.start_tick = start;
            settings.idle = idle;
          }
  return all;
}

TEST(SupgBatch, EqualsPlainTimersForAllSwitchesAndLaneCounts) {
  Stream stream(31, Purpose::test);
  for (const SupgSettings& settings : all_switches()) {
    for (const int lanes : {1, 8, 16, 17}) {
      Pair pair(settings, lanes, stream);
      for (int tick = 0; tick < 120; ++tick) {
        // Now and then a lane gets another controller while the others go on.
        if (stream.chance(0.05)) pair.load(static_cast<int>(stream.below(static_cast<std::uint32_t>(lanes))));
        ASSERT_NO_FATAL_FAILURE(pair.step_and_compare()) << lanes << " lanes, tick " << tick;
      }
    }
  }
}

TEST(SupgBatch, StepsWithLanesThatWereNeverLoaded) {
  const SupgArchitecture architecture(SupgSettings(), supg_substrate(), quadruped(), timestep_s);
  const std::unique_ptr<Batch> batch = architecture.make_batch(16);
  const robot::SensorFrame sensors{LaneArray(legs * types, 16), LaneArray(legs, 16), LaneArray(3, 16)};
  LaneArray targets(legs * types, 16);
  for (int tick = 0; tick < 300; ++tick) batch->step(sensors, targets);
  for (int joint = 0; joint < legs * types; ++joint) EXPECT_TRUE(std::abs(targets.at(joint, 9)) <= 0.8f);
}

}  // namespace supg_twin_test
}  // namespace amble::controllers
