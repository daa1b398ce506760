#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "amble/controllers/ctrnn.hpp"
#include "amble/controllers/logistic_constants.hpp"
#include "amble/controllers/network.hpp"
#include "amble/cppn/activation.hpp"
#include "amble/robot/spec.hpp"

namespace amble::controllers {

/// The logistic function of one number, in the operations of logistic-inl.hpp.
inline float plain_logistic(float x, float slope) {
  namespace c = constants;
  const float scale = -(slope * c::log2_e), largest = c::largest_exponent / (slope * c::log2_e);
  x = std::max(std::min(x, largest), -largest);
  const float k = std::fma(x, scale, c::rounder) - c::rounder;
  const float r = std::fma(x, scale, -k);
  float p = c::e5;
  for (const float coefficient : {c::e4, c::e3, c::e2, c::e1, c::e0}) p = std::fma(p, r, coefficient);
  return 1.0f / (1.0f + std::ldexp(p, static_cast<int>(k)));
}

/// What one robot senses.
struct Senses {
  std::vector<float> angle_rad, touch, attitude_rad;
};

/// The slow twin of networks in a substrate: one robot, node by node, link by link, all passes and steps.
class PlainNetwork {
 public:
  PlainNetwork(const substrate::Layout& layout, substrate::Decoded decoded, double timestep_s,
               const substrate::Settings& substrate)
      : layout_(layout),
        decoded_(std::move(decoded)),
        timestep_s_(timestep_s),
        sine_period_s_(substrate.sine_period_s),
        attitude_(substrate.attitude),
        value_(layout.nodes().size()),
        y_(layout.nodes().size()) {}

  void tick(const NetworkSettings& settings, const Senses& senses) {
    clear(value_);
    sense(senses);
    for (int pass = 0; pass < settings.passes; ++pass) {
      std::vector<float> next = value_;
      for (std::size_t i = 0; i < next.size(); ++i)
        if (is_neuron(i)) next[i] = logistic_of(sum(i, 0.0f), settings.slope);
      value_ = next;
    }
  }

  void tick(const CtrnnSettings& settings, const Senses& senses) {
    sense(senses);
    if (settings.state == StateRule::cleared) clear(y_);
    for (int step = 0; step < settings.steps_per_tick; ++step) {
      if (settings.integrator == Integrator::rk4) {
        const auto k1 = change(settings, y_);
        const auto k2 = change(settings, moved(y_, k1, 0.5f)), k3 = change(settings, moved(y_, k2, 0.5f)),
                   k4 = change(settings, moved(y_, k3, 1.0f));
        for (std::size_t i = 0; i < y_.size(); ++i)
          y_[i] = std::fma(k1[i] + 2.0f * k2[i] + 2.0f * k3[i] + k4[i], 1.0f / 6.0f, y_[i]);
      } else {
        const auto pull = pulls(settings, y_);
        for (std::size_t i = 0; i < y_.size(); ++i)
          if (is_neuron(i)) y_[i] = std::fma(rate(settings, i), pull[i], y_[i]);
      }
    }
    show(settings, y_);
  }

  float value(std::size_t node) const { return value_[node]; }
  /// Driven by the node of joint `joint`, whose stops `its` tells.
  float target_rad(int joint, const robot::Joint& its) const {
    const auto value = static_cast<double>(value_[static_cast<std::size_t>(layout_.driver(joint))]);
    const double command = value < 0.0 ? 0.0 : value > 1.0 ? 1.0 : value;
    return static_cast<float>(its.lower_rad + (its.upper_rad - its.lower_rad) * command);
  }

 private:
  bool is_neuron(std::size_t node) const { return !layout_.nodes()[node].sensor; }

  void clear(std::vector<float>& values) const {
    for (std::size_t i = 0; i < values.size(); ++i)
      if (is_neuron(i)) values[i] = 0.0f;
  }

  void sense(const Senses& senses) {
    using Kind = substrate::Sensor::Kind;
    for (std::size_t i = 0; i < value_.size(); ++i) {
      if (is_neuron(i)) continue;
      const auto sensor = *layout_.nodes()[i].sensor;
      const auto index = static_cast<std::size_t>(sensor.index);
      if (sensor.kind == Kind::angle) value_[i] = senses.angle_rad[index];
      if (sensor.kind == Kind::touch) value_[i] = senses.touch[index];
      const bool swapped = attitude_ == substrate::Attitude::misordered_quaternion;
      if (sensor.kind == Kind::roll) value_[i] = senses.attitude_rad[swapped ? 2 : 0];
      if (sensor.kind == Kind::pitch) value_[i] = senses.attitude_rad[1];
      if (sensor.kind == Kind::yaw) value_[i] = senses.attitude_rad[swapped ? 0 : 2];
      if (swapped && (sensor.kind == Kind::roll || sensor.kind == Kind::yaw)) value_[i] = folded(-value_[i]);
      if (sensor.kind == Kind::sine) value_[i] = sine();
    }
    ++tick_;
  }

  /// Within a right angle, by whole half turns.
  static float folded(float angle_rad) {
    constexpr auto pi = static_cast<float>(std::numbers::pi);
    if (angle_rad > pi / 2) return angle_rad - pi;
    if (angle_rad < -pi / 2) return angle_rad + pi;
    return angle_rad;
  }

  float sine() const {
    const double turns = tick_ * timestep_s_ / sine_period_s_;
    auto x = static_cast<float>((turns - std::floor(turns + 0.5)) * std::numbers::pi);
    cppn::activate(neat::Activation::sine, cppn::Linear::identity, {&x, 1});
    return x;
  }

  /// Sensors first, then neurons.
  float sum(std::size_t node, float sum) const {
    for (const bool neurons : {false, true})
      for (std::size_t i = 0; i < layout_.links().size(); ++i) {
        const auto source = static_cast<std::size_t>(layout_.links()[i].source);
        if (layout_.links()[i].target == static_cast<int>(node) && is_neuron(source) == neurons)
          sum = std::fma(decoded_.weights[i], value_[source], sum);
      }
    return sum;
  }

  static float logistic_of(float x, double slope) { return plain_logistic(x, static_cast<float>(slope)); }

  float rate(const CtrnnSettings& settings, std::size_t node) const {
    const double time_constant = decoded_.of("time_constant")[node];
    auto x = static_cast<float>(settings.step / time_constant);
    if (settings.integrator != Integrator::exponential_euler) return x;
    cppn::activate(neat::Activation::bipolar_sigmoid, cppn::Linear::identity, {&x, 1});
    return 2.0f * x / (1.0f + x);
  }

  void show(const CtrnnSettings& settings, const std::vector<float>& y) {
    for (std::size_t i = 0; i < y.size(); ++i) {
      if (!is_neuron(i)) continue;
      const float bias = decoded_.of("bias")[i];
      value_[i] = settings.equation == Equation::rate ? y[i] : logistic_of(y[i] + bias, settings.slope);
    }
  }

  std::vector<float> pulls(const CtrnnSettings& settings, const std::vector<float>& y) {
    show(settings, y);
    std::vector<float> pull(y.size());
    for (std::size_t i = 0; i < y.size(); ++i) {
      if (!is_neuron(i)) continue;
      const float bias = decoded_.of("bias")[i];
      const bool of_values = settings.equation == Equation::rate;
      float aim = sum(i, of_values ? -bias : 0.0f);
      if (of_values) aim = logistic_of(aim, settings.slope);
      pull[i] = aim - y[i];
    }
    return pull;
  }

  std::vector<float> change(const CtrnnSettings& settings, const std::vector<float>& y) {
    auto change = pulls(settings, y);
    for (std::size_t i = 0; i < y.size(); ++i)
      if (is_neuron(i)) change[i] *= rate(settings, i);
    return change;
  }

  static std::vector<float> moved(std::vector<float> y, const std::vector<float>& change, float share) {
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = std::fma(share, change[i], y[i]);
    return y;
  }

  const substrate::Layout& layout_;
  substrate::Decoded decoded_;
  double timestep_s_, sine_period_s_;
  substrate::Attitude attitude_;
  std::vector<float> value_, y_;
  int tick_ = 0;
};

}  // namespace amble::controllers
