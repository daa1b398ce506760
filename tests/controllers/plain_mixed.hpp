#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "amble/controllers/mixed.hpp"
#include "amble/cppn/activation.hpp"
#include "tests/controllers/mixed_fixture.hpp"
#include "tests/controllers/plain_network.hpp"

namespace amble::controllers {

inline float plain_sine_of_twice(float x) {
  cppn::activate(neat::Activation::sine, cppn::Linear::identity, {&x, 1});
  return x;
}

inline float within_one(float x) {
  return std::clamp(x, -1.0f, 1.0f);
}

/// The mixed controller of a quadruped on the substrate of mixed_fixture.hpp, number by number.
class PlainMixed {
 public:
  static constexpr int legs = 4, types = 3, joints = 12, neurons = 3, period = 17;

  PlainMixed(const MixedArchitecture& architecture, const SupgSettings& settings,
             const MixedParameters& parameters)
      : net_(architecture.net()), settings_(settings), parameters_(parameters), legs_(legs) {
    said_.resize(static_cast<std::size_t>(net_.rows()));
  }

  void tick(const robot::SensorFrame& sensors, int lane) {
    ++tick_;
    for (std::size_t s = 0; s < net_.sensors.size(); ++s)
      said_[s] = net_.sensors[s].sensed(substrate::row_of(net_.sensors[s].sensor, sensors)[lane]);
    std::vector<float> after;
    for (std::size_t n = 0; n < neurons; ++n) {
      const float before = neuron(n);
      const float aim = 2.0f * plain_logistic(sum(net_.hidden[n], parameters_.biases[n]), 2.0f) - 1.0f;
      const float y = std::fma(parameters_.steps[n], aim - before, before);
      after.push_back(std::fabs(y) < 1e-9f ? 0.0f : y);
    }
    std::copy(after.begin(), after.end(), said_.begin() + net_.first_neuron());
    std::vector<float> rho;
    for (int leg = 0; leg < legs; ++leg) rho.push_back(rate_of(leg));
    for (int leg = 0; leg < legs; ++leg)
      grow(legs_[static_cast<std::size_t>(leg)], leg, rho[static_cast<std::size_t>(leg)],
           sensors.touch.at(leg, lane) > 0.5f);
    for (std::size_t supg = 0; supg < joints; ++supg) target_[supg] = target_of(supg);
    for (std::size_t i = 0; i < net_.listened.size(); ++i) {
      const auto supg = static_cast<std::size_t>(net_.listened[i]);
      const JointRange& range = ranges_[supg];
      const auto per_half = static_cast<float>(2.0 / (range.upper_rad - range.lower_rad));
      said_[static_cast<std::size_t>(net_.first_listened()) + i] = (target_[supg] - middle(range)) * per_half;
    }
  }

  float target_rad(int joint) const { return target_[static_cast<std::size_t>(joint)]; }
  float neuron(std::size_t n) const { return said_[static_cast<std::size_t>(net_.first_neuron()) + n]; }
  float timer(int leg) const {
    const std::int32_t parts = legs_[static_cast<std::size_t>(leg)].timer;
    return parts < 0 ? -1.0f : static_cast<float>(parts) / parts_per_tick;
  }

 private:
  struct Leg {
    std::int32_t timer = -1;
    int off_for = 0;
  };

  float sum(const MixedNet::Sum& sum, float start) const {
    for (const auto& [source, index] : sum.links)
      start = std::fma(parameters_.weights[static_cast<std::size_t>(index)],
                       said_[static_cast<std::size_t>(source)], start);
    return start;
  }
  float turns(int leg) const {
    return static_cast<float>(legs_[static_cast<std::size_t>(leg)].timer) *
           (1.0f / static_cast<float>(period * parts_per_tick));
  }
  float wave(int leg, float ahead) const {
    constexpr auto pi = static_cast<float>(std::numbers::pi);
    return legs_[static_cast<std::size_t>(leg)].timer < 0 ? 0.0f
                                                          : plain_sine_of_twice((turns(leg) + ahead) * pi);
  }
  float rate_of(int leg) const {
    float sines = 0.0f, cosines = 0.0f;
    for (std::size_t k = 0; k < net_.couplings.size(); ++k) {
      const auto& [its, other, index] = net_.couplings[k];
      if (its != leg) continue;
      const float sine = wave(other, 0.0f), cosine = wave(other, 0.25f);
      sines = std::fma(-parameters_.out_of_phase[k], cosine, std::fma(parameters_.in_phase[k], sine, sines));
      cosines =
          std::fma(parameters_.in_phase[k], cosine, std::fma(parameters_.out_of_phase[k], sine, cosines));
    }
    const float ahead = sines * wave(leg, 0.25f), behind = cosines * wave(leg, 0.0f);
    return within_one(sum(net_.rates[static_cast<std::size_t>(leg)], 0.0f) + (ahead - behind));
  }
  void grow(Leg& leg, int index, float rho, bool touching) {
    const bool phase = settings_.offset == Offset::phase;
    const std::int32_t whole = period * parts_per_tick, start = settings_.start_tick * parts_per_tick;
    const int first_tick = phase ? 1 : parameters_.offset_ticks(index) + 1;
    const bool triggered = touching && settings_.trigger == Trigger::edge && tick_ > first_tick &&
                           leg.off_for >= settings_.trigger_debounce_ticks;
    if (tick_ == first_tick) leg.timer = phase ? parameters_.offset_ticks(index) * parts_per_tick : start;
    if ((tick_ > first_tick || phase) && leg.timer >= 0) {
      leg.timer += advance_parts(rho);
      if (leg.timer >= whole)
        leg.timer = settings_.idle == Idle::mid    ? -1
                    : settings_.idle == Idle::hold ? whole
                                                   : leg.timer - whole;
    }
    if (triggered) leg.timer = start;
    leg.off_for = touching ? 0 : leg.off_for + 1;
  }
  static float middle(const JointRange& range) {
    return static_cast<float>(0.5 * (range.lower_rad + range.upper_rad));
  }
  float target_of(std::size_t supg) const {
    const int leg = static_cast<int>(supg) / types, type = static_cast<int>(supg) % types;
    const std::int32_t timer = legs_[static_cast<std::size_t>(leg)].timer;
    const int entry = timer < 0 ? -1 : timer >> parts_bits;
    const float share =
        timer < 0 ? 0.0f : static_cast<float>(timer & (parts_per_tick - 1)) * (1.0f / parts_per_tick);
    const float a = parameters_.modulation().entry(leg, entry)[type],
                b = parameters_.modulation().entry(leg, entry + 1)[type];
    float y = a + share * (b - a);
    const JointRange& range = ranges_[supg];
    const auto half = static_cast<float>(0.5 * (range.upper_rad - range.lower_rad));
    const float more = (y - middle(range)) * within_one(sum(net_.amplitudes[supg], 0.0f));
    const float shift = within_one(sum(net_.shifts[supg], 0.0f)) * half;
    if (net_.reshapes(supg)) y = (y + more) + shift;
    return std::clamp(y, range.at(0.0), range.at(1.0));
  }

  const MixedNet& net_;
  SupgSettings settings_;
  const MixedParameters& parameters_;
  std::vector<JointRange> ranges_ = joint_ranges(quadruped());
  std::vector<Leg> legs_;
  std::vector<float> said_;
  std::array<float, joints> target_{};
  int tick_ = 0;
};

}  // namespace amble::controllers
