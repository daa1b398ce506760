#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "amble/controllers/modulated_supg_batch.hpp"
#include "amble/controllers/modulation.hpp"

namespace amble::controllers {

/// One leg of modulated SUPGs, number by number.
class PlainModulatedLeg {
 public:
  PlainModulatedLeg(const SupgSettings& settings, const ModulatedParameters& parameters, int leg)
      : settings_(settings), parameters_(parameters), leg_(leg), period_(parameters.period_ticks()) {}

  void tick(bool touching, const std::vector<float>& sensed, float load = 0.0f) {
    ++tick_;
    float rho = 0.0f;
    if (settings_.modulation.rate > 0.0)
      for (std::size_t s = 0; s < sensed.size(); ++s)
        rho = rho + parameters_.modulation().rate(leg_, static_cast<int>(s)) * sensed[s];
    // Another test compares this with 2^ρ.
    double growth = advance_parts(std::clamp(rho, -1.0f, 1.0f)) / 16384.0;
    if (settings_.modulation.load_feedback > 0.0) {
      const double phase = std::max(0.0, std::floor(timer)) / period_;
      const float pull = static_cast<float>(settings_.modulation.load_feedback) * load;
      const float ticks = pull * static_cast<float>(std::cos(2.0 * std::numbers::pi * phase));
      growth = std::clamp(growth - std::trunc(static_cast<double>(ticks) * 16384.0) / 16384.0, 0.0, 2.0);
    }
    const bool phase = settings_.offset == Offset::phase;
    const int first_tick = phase ? 1 : parameters_.offset_ticks(leg_) + 1;
    const bool lands = touching && settings_.trigger != Trigger::none &&
                       (settings_.trigger == Trigger::level || off_for_ >= settings_.trigger_debounce_ticks);
    triggered = lands && tick_ > first_tick && rests_ == 0;
    if (tick_ == first_tick) timer = phase ? parameters_.offset_ticks(leg_) : settings_.start_tick;
    if ((tick_ > first_tick || (tick_ == first_tick && phase)) && timer >= 0.0) grow(growth);
    if (triggered) reset();
    rests_ = triggered ? settings_.modulation.refractory_ticks : std::max(rests_ - 1, 0);
    off_for_ = touching ? 0 : off_for_ + 1;
  }

  float target_rad(int type, const std::vector<float>& sensed, const JointRange& range) const {
    const Modulation& modulation = parameters_.modulation();
    const double whole = timer < 0.0 ? -1.0 : std::floor(timer);
    const auto share = static_cast<float>(timer < 0.0 ? 0.0 : timer - whole);
    const auto read = [&](int group) {
      const int at = group * modulation.width() + type;
      const float a = modulation.entry(leg_, static_cast<int>(whole))[at];
      const float b = modulation.entry(leg_, static_cast<int>(whole) + 1)[at];
      return a + share * (b - a);
    };
    float y = read(0);
    int channel = 0;
    for (const float s : sensed)
      if (settings_.modulation.shape_by == ShapeBy::gain)
        y = y + read(++channel) * s;
      else
        for (const float level : {-1.0f, -0.5f, 0.5f, 1.0f})
          y = y + read(++channel) * std::max(0.0f, 1.0f - std::fabs(2.0f * s - 2.0f * level));
    return std::clamp(y, range.at(0.0), range.at(1.0));
  }

  double timer = -1.0;
  bool triggered = false;

 private:
  void grow(double growth) {
    timer = std::min(timer, static_cast<double>(period_)) + growth;
    if (timer < period_) return;
    if (settings_.idle == Idle::mid) timer = -1.0;
    if (settings_.idle == Idle::hold) timer = period_;
    if (settings_.idle == Idle::wrap) timer -= period_;
  }
  void reset() {
    const double share = std::round(settings_.modulation.reset * 32768.0) / 32768.0,
                 start = settings_.start_tick;
    if (share == 0.0) return;
    if (timer < 0.0) {
      timer = start;
      return;
    }
    double way = start - timer;
    if (way <= -0.5 * period_) way += period_;
    const double parts = std::trunc(way * 16384.0 * share);
    timer += parts / 16384.0;
    if (timer >= period_) timer -= period_;
  }

  SupgSettings settings_;
  const ModulatedParameters& parameters_;
  int leg_, period_;
  int tick_ = 0, off_for_ = 0, rests_ = 0;
};

}  // namespace amble::controllers
