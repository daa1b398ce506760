#include "amble/controllers/supg_kernel.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <bit>
#include <cstdint>
#include <vector>

#include "amble/controllers/lane_rows.hpp"
#include "amble/controllers/supg_targets.hpp"
#include "amble/core/random.hpp"

namespace amble::controllers {
namespace supg_kernel_test {

using Ints = std::vector<std::int32_t>;
using Floats = std::vector<float>;

Ints ints(int count, int least, int most, Stream& stream) {
  Ints values(static_cast<std::size_t>(count));
  for (auto& value : values)
    value = least + static_cast<int>(stream.below(static_cast<std::uint32_t>(most - least + 1)));
  return values;
}
Ints masks(int count, Stream& stream) {
  Ints values(static_cast<std::size_t>(count));
  for (auto& value : values) value = stream.chance(0.2) ? -1 : 0;
  return values;
}
Floats floats(int count, Stream& stream) {
  Floats values(static_cast<std::size_t>(count));
  for (auto& value : values) value = static_cast<float>(stream.uniform(-1.5, 1.5));
  return values;
}

/// All bits that the kernels write, for so many lanes, from the same numbers each time.
class AllKernels {
 public:
  explicit AllKernels(int lanes) : lanes_(lanes) {}

  std::vector<std::uint32_t> written() {
    timers();
    rows();
    joints();
    targets();
    entries();
    weights();
    return bits_;
  }

 private:
  void note(const Ints& values) {
    for (const std::int32_t value : values) bits_.push_back(static_cast<std::uint32_t>(value));
  }
  void note(const Floats& values) {
    for (const float value : values) bits_.push_back(std::bit_cast<std::uint32_t>(value));
  }

  void timers() {
    const TimerRules rules{.period = 5 * parts_per_tick,
                           .end_of_cycle = -1,
                           .wraps = -1,
                           .airborne_needed = 2,
                           .by_touch = -1,
                           .phase = -1,
                           .refractory = 3};
    for (const bool whole : {true, false}) {
      const Floats contact = floats(lanes_, stream_);
      const Ints chance = masks(lanes_, stream_), first = ints(lanes_, 0, 3, stream_);
      Ints timer = ints(lanes_, -1, whole ? 5 : 5 * parts_per_tick, stream_),
           airborne = ints(lanes_, 0, 2, stream_), wait = ints(lanes_, -1, 2, stream_), fired(timer.size()),
           continued(timer.size()), left = ints(lanes_, 0, 1, stream_);
      const TimerLanes lanes{contact.data(),  chance.data(), first.data(), timer.data(),
                             airborne.data(), wait.data(),   fired.data()};
      if (whole)
        run_ticks(rules, 1, lanes, lanes_);
      else
        bits_.push_back(run_parts(rules, ints(lanes_, 0, 2 * parts_per_tick, stream_).data(), lanes,
                                  continued.data(), left.data(), lanes_));
      for (const Ints* values : {&timer, &airborne, &wait, &fired, &continued, &left}) note(*values);
    }
  }

  void rows() {
    const Floats reading = floats(lanes_, stream_);
    LaneRows sensed(2, lanes_), rates(2, lanes_);
    const SensedRow both[] = {{reading.data(), 0.7f, 0.1f, sensed.row(0)},
                              {nullptr, 1.0f, 0.0f, sensed.row(1)}};
    run_sensed(both, lanes_);
    for (int row = 0; row < 2; ++row)
      for (int lane = 0; lane < lanes_; ++lane)
        rates.at(row, lane) = static_cast<float>(stream_.uniform(-1.0, 1.0));
    Ints advance(reading.size());
    run_rates(rates.data(), sensed.data(), sensed.stride(), 2, advance.data(), lanes_);
    note(Floats(sensed.row(0), sensed.row(0) + lanes_));
    note(advance);
    const Floats sum = floats(lanes_, stream_), sine = floats(lanes_, stream_),
                 cosine = floats(lanes_, stream_);
    for (const float* sines : {static_cast<const float*>(nullptr), reading.data()}) {
      run_pulled_rates({sum.data(), sine.data(), cosine.data(), sines, reading.data()}, advance.data(),
                       lanes_);
      note(advance);
    }
  }

  void joints() {
    Floats y = floats(lanes_, stream_), residual = floats(lanes_, stream_), z = floats(lanes_, stream_);
    const Floats a = floats(lanes_, stream_), b = floats(lanes_, stream_);
    const Ints jumped = masks(lanes_, stream_);
    run_reshape({a.data(), b.data(), 0.2f, 0.8f}, y.data(), lanes_);
    note(y);
    run_residual({.decay = 0.9f,
                  .lower_rad = -1.0f,
                  .upper_rad = 1.0f,
                  .continued_rad = a.data(),
                  .present_rad = b.data(),
                  .jumped = jumped.data(),
                  .residual_rad = residual.data()},
                 y.data(), lanes_);
    run_filter(0.3f, z.data(), y.data(), lanes_);
    const LimitedRow row{y.data(), -0.5f, 0.5f, y.data()};
    run_limits({&row, 1}, lanes_);
    for (const Floats* values : {&y, &residual, &z}) note(*values);
  }

  /// One to seven types; no channels to four; entries as they come, and with room behind them.
  void targets() {
    for (const int width : {4, 8})
      for (int channels = 0; channels <= 4; ++channels)
        for (const int room : {0, 1}) {
          const int stride_bits =
              static_cast<int>(std::bit_width(static_cast<unsigned>(width * (channels + 1) - 1))) + room;
          const Floats table = floats(2 * 8 << stride_bits, stream_);
          const std::vector<const float*> tables(static_cast<std::size_t>(lanes_),
                                                 table.data() + (8 << stride_bits));
          const Ints timers = ints(lanes_, -1, 5 * parts_per_tick, stream_);
          LaneRows says(channels, lanes_);
          for (int lane = 0; lane < lanes_; ++lane)
            for (int channel = 0; channel < channels; ++channel)
              says.at(channel, lane) = static_cast<float>(stream_.uniform(-1.0, 1.0));
          Floats y(static_cast<std::size_t>(width * lanes_));
          run_targets({tables.data(), stride_bits, width, channels, says.data(), says.stride()},
                      timers.data(), 0, lanes_, lanes_, y.data());
          note(y);
          plain(table, timers, says, stride_bits, width, channels, y);
        }
  }

  /// As it is defined: P + Σ s D at a timer, between two entries.
  void plain(const Floats& table, const Ints& timers, const LaneRows& says, int stride_bits, int width,
             int channels, const Floats& y) {
    for (int lane = 0; lane < lanes_; ++lane) {
      const std::int32_t timer = timers[static_cast<std::size_t>(lane)],
                         at = 8 + (timer < 0 ? 0 : 1 + timer / parts_per_tick);
      const float share = timer < 0 ? 0.0f : static_cast<float>(timer % parts_per_tick) / parts_per_tick;
      for (int type = 0; type < width; ++type) {
        const auto between = [&](int group) {
          const std::size_t here = static_cast<std::size_t>((at << stride_bits) + group * width + type);
          const float a = table[here], b = table[here + (std::size_t{1} << stride_bits)];
          return a + share * (b - a);
        };
        float target = between(0);
        for (int channel = 0; channel < channels; ++channel)
          target += between(1 + channel) * says.at(channel, lane);
        ASSERT_EQ(target, y[static_cast<std::size_t>(type * lanes_ + lane)]);
      }
    }
  }

  /// Of two legs with one to five types, of which the first leg lacks one.
  void entries() {
    for (int types = 1; types <= 5; ++types) {
      constexpr int period = 5;
      const Floats table = floats((period + 2) * types + 3, stream_);
      const std::vector<const float*> tables(static_cast<std::size_t>(2 * lanes_), table.data() + types);
      const Ints timers = ints(2 * lanes_, -1, period, stream_);
      LaneRows rows(2 * types, lanes_);
      std::vector<float*> to;
      for (int row = 0; row < 2 * types; ++row) to.push_back(row == types - 1 ? nullptr : rows.row(row));
      run_entries({.tables = tables.data(), .timers = timers.data(), .to = to}, types, lanes_);
      for (int row = 0; row < 2 * types; ++row)
        for (int lane = 0; lane < lanes_; ++lane) {
          const int timer = timers[static_cast<std::size_t>(row / types * lanes_ + lane)];
          const float there = table[static_cast<std::size_t>((timer + 1) * types + row % types)];
          ASSERT_EQ(rows.at(row, lane), row == types - 1 ? 0.0f : there);
        }
      note(Floats(rows.data(), rows.data() + rows.stride() * static_cast<std::size_t>(2 * types)));
    }
  }

  void weights() {
    constexpr int levels = static_cast<int>(reading_levels.size());
    LaneRows sensed(2, lanes_), weights(2 * levels, lanes_);
    for (int row = 0; row < 2; ++row)
      for (int lane = 0; lane < lanes_; ++lane)
        sensed.at(row, lane) = static_cast<float>(static_cast<int>(stream_.below(33)) - 16) / 16.0f;
    run_weights(sensed.data(), sensed.stride(), 2, weights.data(), lanes_);
    for (int row = 0; row < 2 * levels; ++row) {
      const float level = reading_levels[static_cast<std::size_t>(row % levels)];
      for (int lane = 0; lane < lanes_; ++lane)
        ASSERT_EQ(weights.at(row, lane), weight_of_level(sensed.at(row / levels, lane), level));
      note(Floats(weights.row(row), weights.row(row) + lanes_));
    }
  }

  int lanes_;
  Stream stream_{46, Purpose::test};
  std::vector<std::uint32_t> bits_;
};

TEST(SupgKernel, WritesTheSameBitsOnEveryInstructionSet) {
  const std::int64_t supported = hwy::SupportedTargets();
  for (const int lanes : {1, 3, 5, 16, 17, 40, 100}) {
    hwy::SetSupportedTargetsForTest(HWY_SCALAR);
    const auto expected = AllKernels(lanes).written();
    for (const std::int64_t set : {std::int64_t{HWY_AVX3}, std::int64_t{HWY_AVX2}}) {
      if ((supported & set) == 0) continue;
      hwy::SetSupportedTargetsForTest(set);
      EXPECT_EQ(AllKernels(lanes).written(), expected) << lanes << " lanes, " << hwy::TargetName(set);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace supg_kernel_test
}  // namespace amble::controllers
