// Sine, cosine and arc tangent of a vector, for each instruction set. The polynomials are interpolations at
// Chebyshev nodes.
#if defined(AMBLE_BATCH_TRIGONOMETRY_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef AMBLE_BATCH_TRIGONOMETRY_INL_HPP
#undef AMBLE_BATCH_TRIGONOMETRY_INL_HPP
#else
#define AMBLE_BATCH_TRIGONOMETRY_INL_HPP
#endif

#include "amble/physics/batch/vector-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::physics::batch::HWY_NAMESPACE {

struct SineCosine {
  V sine, cosine;
};

/// Absolute error below 2e-7 within ± 100 rad.
HWY_INLINE SineCosine sine_cosine(V angle) {
  const Ints ints;
  const Floats d;
  // angle = k π/2 + r with r within ± π/4; π/2 is subtracted in two parts (Cody and Waite 1980).
  const V k = hn::Round(angle * set(0.636619772f));
  V r = fnma(k, set(1.57079625129699707031f), angle);
  r = fnma(k, set(7.54978941586159635335e-8f), r);
  // sin r = r + r³ S(r²), cos r = 1 − r²/2 + r⁴ C(r²).
  const V u = r * r;
  const V one = set(1.0f);
  V s = fma(u, set(-1.95878909e-4f), set(8.33274827e-3f));
  s = fma(u, s, set(-1.66666647e-1f));
  s = fma(u * r, s, r);
  V c = fma(u, set(2.45479421e-5f), set(-1.38883030e-3f));
  c = fma(u, c, set(4.16666647e-2f));
  c = fma(u * u, c, fnma(u, set(0.5f), one));
  // An odd k swaps the two; k mod 4 gives the signs.
  const auto quarters = hn::ConvertTo(ints, k);
  const auto odd = hn::MaskFromVec(hn::BitCast(d, hn::ShiftRight<31>(hn::ShiftLeft<31>(quarters))));
  const auto sign_bit = hn::Set(ints, INT32_MIN);
  const auto sine_sign = hn::And(hn::ShiftLeft<30>(quarters), sign_bit);
  const auto cosine_sign = hn::And(hn::ShiftLeft<30>(hn::Add(quarters, hn::Set(ints, 1))), sign_bit);
  return {hn::Xor(hn::IfThenElse(odd, c, s), hn::BitCast(d, sine_sign)),
          hn::Xor(hn::IfThenElse(odd, s, c), hn::BitCast(d, cosine_sign))};
}

/// atan2(y, x), absolute error below 4e-7; 0 where both are 0.
HWY_INLINE V arc_tangent(V y, V x) {
  constexpr float pi = 3.14159265f;
  const V long_side = max(hn::Abs(x), hn::Abs(y)), short_side = min(hn::Abs(x), hn::Abs(y));
  V t = short_side / max(long_side, set(1e-30f));  // 0 … 1
  // Above tan(π/8): atan t = π/4 + atan((t − 1) / (t + 1)).
  const Mask steep = t > set(0.414213562f);
  t = hn::IfThenElse(steep, (t - set(1.0f)) / (t + set(1.0f)), t);
  // atan t = t + t³ P(t²).
  const V u = t * t;
  V p = fma(u, set(8.52049204e-2f), set(-1.40241428e-1f));
  p = fma(u, p, set(1.99912377e-1f));
  p = fma(u, p, set(-3.33332866e-1f));
  V angle = fma(u * t, p, t);
  angle = hn::IfThenElse(steep, angle + set(0.25f * pi), angle);
  angle = hn::IfThenElse(hn::Abs(y) > hn::Abs(x), set(0.5f * pi) - angle, angle);
  angle = hn::IfThenElse(x < zero(), set(pi) - angle, angle);
  return hn::IfThenElse(y < zero(), hn::Neg(angle), angle);
}

}  // namespace amble::physics::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggled by HWY_TARGET_TOGGLE
