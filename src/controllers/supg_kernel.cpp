#include "amble/controllers/supg_kernel.hpp"

#include <algorithm>

#include "amble/core/simd_targets.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "amble/controllers/supg_kernel.cpp"
#include <hwy/foreach_target.h>

#include "amble/controllers/for_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::controllers::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Within a range; `lower` for what is not a number.
template <typename D, typename Vec = hn::Vec<D>>
HWY_INLINE Vec limited(D f, Vec value, float lower, float upper) {
  const Vec least = hn::Set(f, lower), most = hn::Set(f, upper);
  const Vec above = hn::IfThenElse(hn::Gt(value, least), value, least);
  return hn::IfThenElse(hn::Lt(above, most), above, most);
}

/// advance_parts() of ρ, which is limited first.
template <typename D, typename Vec = hn::Vec<D>>
HWY_INLINE void write_advance(D f, Vec rho, std::int32_t* to) {
  const hn::RebindToSigned<D> i;
  rho = limited(f, rho, -1.0f, 1.0f);
  Vec power = hn::Set(f, power_of_two_series[0]);
  for (std::size_t k = 1; k < power_of_two_series.size(); ++k)
    power = hn::Add(hn::Mul(power, rho), hn::Set(f, power_of_two_series[k]));
  const Vec and_a_half =
      hn::Add(hn::Mul(power, hn::Set(f, static_cast<float>(parts_per_tick))), hn::Set(f, 0.5f));
  hn::StoreU(hn::ConvertTo(i, and_a_half), i, to);
}

/// A leg's trigger in some lanes, and what else changes with it.
template <typename D>
struct Contact {
  using I = hn::RebindToSigned<D>;
  using Int = hn::Vec<I>;

  Int waiting;
  hn::Mask<I> triggered;

  /// Reads what was, and writes all but the timers and what is left of the refractory time. `may`: lanes that
  /// may be triggered.
  HWY_INLINE Contact(const TimerRules& rules, const TimerLanes& lanes, hn::Mask<I> may, int lane) {
    const I i;
    const Int zero = hn::Zero(i), one = hn::Set(i, 1), needed = hn::Set(i, rules.airborne_needed);
    const Int off_ground = hn::LoadU(i, lanes.airborne + lane);
    waiting = hn::LoadU(i, lanes.wait + lane);
    const auto touches = hn::RebindMask(i, hn::Gt(hn::LoadU(D(), lanes.contact + lane), hn::Set(D(), 0.5f)));
    const auto by_touch = hn::And(hn::And(touches, hn::Ne(hn::Set(i, rules.by_touch), zero)),
                                  hn::Not(hn::Lt(off_ground, needed)));
    const auto by_chance = hn::Ne(hn::LoadU(i, lanes.by_chance + lane), zero);
    triggered = hn::And(hn::And(may, hn::Lt(waiting, zero)), hn::Or(by_touch, by_chance));
    hn::StoreU(hn::IfThenElseZero(triggered, one), i, lanes.fired + lane);
    hn::StoreU(hn::Max(hn::Sub(waiting, one), hn::Set(i, -1)), i, lanes.wait + lane);
    hn::StoreU(hn::IfThenZeroElse(touches, hn::Min(hn::Add(off_ground, one), needed)), i,
               lanes.airborne + lane);
  }
};

void ticks(const TimerRules& rules, std::int32_t start, const TimerLanes& lanes, int count) {
  for_lanes(count, [&](auto f, int lane) HWY_ATTR {
    const hn::RebindToSigned<decltype(f)> i;
    const auto zero = hn::Zero(i), stopped = hn::Set(i, -1), before = hn::LoadU(i, lanes.timer + lane);
    const Contact<decltype(f)> contact(rules, lanes, hn::Eq(zero, zero), lane);
    auto next = hn::Add(before, hn::Set(i, 1));
    next = hn::IfThenElse(hn::Lt(next, hn::Set(i, rules.period)), next, hn::Set(i, rules.end_of_cycle));
    next = hn::IfThenElse(hn::Eq(before, stopped), stopped, next);
    next = hn::IfThenElse(contact.triggered, hn::Set(i, start), next);
    next = hn::IfThenElse(hn::Eq(contact.waiting, zero), hn::LoadU(i, lanes.first_timer + lane), next);
    hn::StoreU(next, i, lanes.timer + lane);
  });
}

bool parts(const TimerRules& rules, const std::int32_t* advance, const TimerLanes& lanes,
           std::int32_t* continued, std::int32_t* left, int count) {
  bool any = false;
  for_lanes(count, [&](auto f, int lane) HWY_ATTR {
    const hn::RebindToSigned<decltype(f)> i;
    const auto zero = hn::Zero(i), stopped = hn::Set(i, -1), period = hn::Set(i, rules.period);
    const auto resting = hn::LoadU(i, left + lane), first = hn::LoadU(i, lanes.first_timer + lane);
    const Contact<decltype(f)> contact(rules, lanes, hn::Eq(resting, zero), lane);
    any |= !hn::AllFalse(i, contact.triggered);
    const auto rest = hn::Max(hn::Sub(resting, hn::Set(i, 1)), zero);
    hn::StoreU(hn::IfThenElse(contact.triggered, hn::Set(i, rules.refractory), rest), i, left + lane);

    const auto phase = hn::Ne(hn::Set(i, rules.phase), zero), begins = hn::Eq(contact.waiting, zero);
    const auto before = hn::IfThenElse(hn::And(begins, phase), first, hn::LoadU(i, lanes.timer + lane));
    const auto stands = hn::Lt(before, zero);
    const auto sum = hn::Add(before, hn::LoadU(i, advance + lane));
    const auto end = rules.wraps != 0 ? hn::Sub(sum, period) : hn::Set(i, rules.end_of_cycle);
    const auto next = hn::IfThenElse(stands, stopped, hn::IfThenElse(hn::Lt(sum, period), sum, end));
    const auto on = hn::IfThenElse(stands, stopped, hn::Min(sum, period));
    hn::StoreU(hn::IfThenElse(hn::And(begins, phase), next, on), i, continued + lane);
    hn::StoreU(hn::IfThenElse(hn::AndNot(phase, begins), first, next), i, lanes.timer + lane);
  });
  return any;
}

void sensed(std::span<const SensedRow> rows, int count) {
  for (const SensedRow& row : rows) {
    if (row.reading == nullptr)
      std::fill_n(row.sensed, count, 0.0f);
    else
      for_lanes(count, [&](auto f, int lane) HWY_ATTR {
        const auto scaled = hn::Mul(hn::LoadU(f, row.reading + lane), hn::Set(f, row.gain));
        hn::StoreU(limited(f, hn::Sub(scaled, hn::Set(f, row.shift)), -1.0f, 1.0f), f, row.sensed + lane);
      });
  }
}

void weights(const float* sensed, std::size_t stride, int rows, float* weights, int count) {
  for (int row = 0; row < rows; ++row, sensed += stride)
    for (const float level : reading_levels) {
      for_lanes(count, [&](auto f, int lane) HWY_ATTR {
        const auto s = hn::LoadU(f, sensed + lane), away = hn::Sub(hn::Add(s, s), hn::Set(f, level + level)),
                   near = hn::Sub(hn::Set(f, 1.0f), hn::Abs(away));
        hn::StoreU(hn::IfThenElseZero(hn::Gt(near, hn::Zero(f)), near), f, weights + lane);
      });
      weights += stride;
    }
}

void rates(const float* rates, const float* sensed, std::size_t stride, int rows, std::int32_t* advance,
           int count) {
  for_lanes(count, [&](auto f, int lane) HWY_ATTR {
    auto rho = hn::Zero(f);
    for (std::size_t at = static_cast<std::size_t>(lane), end = at + static_cast<std::size_t>(rows) * stride;
         at < end; at += stride)
      rho = hn::Add(rho, hn::Mul(hn::LoadU(f, rates + at), hn::LoadU(f, sensed + at)));
    write_advance(f, rho, advance + lane);
  });
}

void pulled_rates(const PulledRates& rates, std::int32_t* advance, int count) {
  for_lanes(count, [&](auto f, int lane) HWY_ATTR {
    auto rho = hn::LoadU(f, rates.sum + lane);
    if (rates.sines != nullptr) {
      const auto ahead = hn::Mul(hn::LoadU(f, rates.sines + lane), hn::LoadU(f, rates.cosine + lane));
      rho = hn::Add(
          rho, hn::Sub(ahead, hn::Mul(hn::LoadU(f, rates.cosines + lane), hn::LoadU(f, rates.sine + lane))));
    }
    write_advance(f, rho, advance + lane);
  });
}

void reshape(const Reshaping& how, float* targets_rad, int count) {
  for_lanes(count, [&](auto f, int lane) HWY_ATTR {
    const auto y = hn::LoadU(f, targets_rad + lane);
    const auto a = limited(f, hn::LoadU(f, how.amplitude + lane), -1.0f, 1.0f),
               b = limited(f, hn::LoadU(f, how.shift + lane), -1.0f, 1.0f);
    const auto more = hn::Mul(hn::Sub(y, hn::Set(f, how.middle_rad)), a);
    hn::StoreU(hn::Add(hn::Add(y, more), hn::Mul(b, hn::Set(f, how.half_rad))), f, targets_rad + lane);
  });
}

void limits(std::span<const LimitedRow> rows, int count) {
  for (const LimitedRow& row : rows)
    for_lanes(count, [&](auto f, int lane) HWY_ATTR {
      hn::StoreU(limited(f, hn::LoadU(f, row.from + lane), row.lower, row.upper), f, row.to + lane);
    });
}

/// Numbers that fade would become denormal, which is slow, and not the same everywhere.
template <typename D, typename Vec = hn::Vec<D>>
HWY_INLINE Vec without_dust(D f, Vec value_rad) {
  const Vec dust_rad = hn::Set(f, 1e-9f);
  return hn::IfThenElseZero(hn::Or(hn::Gt(value_rad, dust_rad), hn::Lt(value_rad, hn::Neg(dust_rad))),
                            value_rad);
}

void residual(const Residual& of, float* targets_rad, int count) {
  for_lanes(count, [&](auto f, int lane) HWY_ATTR {
    const hn::RebindToSigned<decltype(f)> i;
    const auto left = without_dust(f, hn::Mul(hn::Set(f, of.decay), hn::LoadU(f, of.residual_rad + lane)));
    const auto y =
        limited(f, hn::Add(hn::LoadU(f, of.continued_rad + lane), left), of.lower_rad, of.upper_rad);
    const auto taken = hn::Sub(y, hn::LoadU(f, of.present_rad + lane));
    const auto jumped = hn::RebindMask(f, hn::Ne(hn::LoadU(i, of.jumped + lane), hn::Zero(i)));
    hn::StoreU(hn::IfThenElse(jumped, taken, left), f, of.residual_rad + lane);
    hn::StoreU(y, f, targets_rad + lane);
  });
}

void filter(float share, float* z_rad, float* targets_rad, int count) {
  for_lanes(count, [&](auto f, int lane) HWY_ATTR {
    const auto z = hn::LoadU(f, z_rad + lane),
               more = hn::Mul(hn::Set(f, share), hn::Sub(hn::LoadU(f, targets_rad + lane), z));
    const auto next = without_dust(f, hn::Add(z, more));
    hn::StoreU(next, f, z_rad + lane);
    hn::StoreU(next, f, targets_rad + lane);
  });
}

}  // namespace amble::controllers::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace amble::controllers {

HWY_EXPORT(ticks);
HWY_EXPORT(parts);
HWY_EXPORT(sensed);
HWY_EXPORT(weights);
HWY_EXPORT(rates);
HWY_EXPORT(pulled_rates);
HWY_EXPORT(reshape);
HWY_EXPORT(limits);
HWY_EXPORT(residual);
HWY_EXPORT(filter);

void run_ticks(const TimerRules& rules, std::int32_t start, const TimerLanes& lanes, int count) {
  HWY_DYNAMIC_DISPATCH(ticks)(rules, start, lanes, count);
}

bool run_parts(const TimerRules& rules, const std::int32_t* advance, const TimerLanes& lanes,
               std::int32_t* continued, std::int32_t* left, int count) {
  return HWY_DYNAMIC_DISPATCH(parts)(rules, advance, lanes, continued, left, count);
}

void run_sensed(std::span<const SensedRow> rows, int count) {
  HWY_DYNAMIC_DISPATCH(sensed)(rows, count);
}

void run_weights(const float* sensed, std::size_t stride, int rows, float* weights, int count) {
  HWY_DYNAMIC_DISPATCH(weights)(sensed, stride, rows, weights, count);
}

void run_rates(const float* rates, const float* sensed, std::size_t stride, int rows, std::int32_t* advance,
               int count) {
  HWY_DYNAMIC_DISPATCH(rates)(rates, sensed, stride, rows, advance, count);
}

void run_pulled_rates(const PulledRates& rates, std::int32_t* advance, int count) {
  HWY_DYNAMIC_DISPATCH(pulled_rates)(rates, advance, count);
}

void run_reshape(const Reshaping& how, float* targets_rad, int count) {
  HWY_DYNAMIC_DISPATCH(reshape)(how, targets_rad, count);
}

void run_limits(std::span<const LimitedRow> rows, int count) {
  HWY_DYNAMIC_DISPATCH(limits)(rows, count);
}

void run_residual(const Residual& of, float* targets_rad, int count) {
  HWY_DYNAMIC_DISPATCH(residual)(of, targets_rad, count);
}

void run_filter(float share, float* z_rad, float* targets_rad, int count) {
  HWY_DYNAMIC_DISPATCH(filter)(share, z_rad, targets_rad, count);
}

}  // namespace amble::controllers
#endif
