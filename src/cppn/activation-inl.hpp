// The activation functions on one vector, for each instruction set: included once per target through
// Highway's foreach_target.
#if defined(AMBLE_CPPN_ACTIVATION_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef AMBLE_CPPN_ACTIVATION_INL_HPP
#undef AMBLE_CPPN_ACTIVATION_INL_HPP
#else
#define AMBLE_CPPN_ACTIVATION_INL_HPP
#endif

#include <cstddef>
#include <cstdint>

#include "amble/core/simd-inl.hpp"
#include "amble/cppn/activation.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::cppn::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace c = constants;

using simd::HWY_NAMESPACE::Floats;
using simd::HWY_NAMESPACE::Ints;
using simd::HWY_NAMESPACE::max;
using simd::HWY_NAMESPACE::min;
using Vector = simd::HWY_NAMESPACE::V;

/// a x + b, rounded twice.
HWY_INLINE Vector times_plus(Vector a, Vector x, float b) {
  return hn::Add(hn::Mul(a, x), hn::Set(Floats(), b));
}

/// e^z = 2^k e^r for z ≤ 0, with z = k ln 2 + r and |r| ≤ ln(2)/2.
HWY_INLINE Vector exp_of_negative(Vector z) {
  const Floats d;
  const Ints i;
  z = max(z, hn::Set(d, c::lowest_exponent));
  const Vector sum = hn::Add(hn::Mul(z, hn::Set(d, c::log2_e)), hn::Set(d, c::rounder));
  const Vector k = hn::Sub(sum, hn::Set(d, c::rounder));
  Vector r = hn::Sub(z, hn::Mul(k, hn::Set(d, c::ln2_high)));
  r = hn::Sub(r, hn::Mul(k, hn::Set(d, c::ln2_low)));
  // e^r = 1 + r + r² P(r).
  Vector p = times_plus(hn::Set(d, c::e6), r, c::e5);
  p = times_plus(p, r, c::e4);
  p = times_plus(p, r, c::e3);
  p = times_plus(p, r, c::e2);
  p = hn::Add(hn::Mul(p, hn::Mul(r, r)), r);
  p = hn::Add(p, hn::Set(d, 1.0f));
  // The low bits of `sum` are k; shifted up they are added to the exponent of p.
  return hn::BitCast(d, hn::Add(hn::BitCast(i, p), hn::ShiftLeft<23>(hn::BitCast(i, sum))));
}

/// As tanh(x/2) = sign(x) (1 − e^−|x|) / (1 + e^−|x|), which is exactly odd.
HWY_INLINE Vector bipolar_sigmoid(Vector x) {
  const Vector one = hn::Set(Floats(), 1.0f);
  const Vector t = exp_of_negative(hn::Neg(hn::Abs(x)));
  return hn::CopySign(hn::Div(hn::Sub(one, t), hn::Add(one, t)), x);
}

/// 2 e^−(2.5 x)² − 1.
HWY_INLINE Vector gaussian(Vector x) {
  const Floats d;
  const Vector a = hn::Mul(hn::Set(d, 2.5f), x);
  const Vector e = exp_of_negative(hn::Neg(hn::Mul(a, a)));
  return hn::Sub(hn::Add(e, e), hn::Set(d, 1.0f));
}

/// Replaces the angles of lanes with |x| > near_sine by those of the slow exact reduction.
HWY_NOINLINE Vector with_large_angles(Vector x, Vector angle) {
  const Floats d;
  HWY_ALIGN float arguments[hn::MaxLanes(d)], angles[hn::MaxLanes(d)];
  hn::Store(x, d, arguments);
  hn::Store(angle, d, angles);
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    const float argument = arguments[lane];
    if (argument > c::near_sine || argument < -c::near_sine) angles[lane] = sine_angle_of_large(argument);
  }
  return hn::Load(d, angles);
}

/// sin(2 x).
HWY_INLINE Vector sine(Vector x) {
  const Floats d;
  const Ints i;
  // 2x = k π + r; sin(2x) is sin(r), negative for odd k: so the sign goes to r, since the polynomial is odd.
  const Vector y = hn::Add(x, x);
  const Vector sum = hn::Add(hn::Mul(y, hn::Set(d, c::one_over_pi)), hn::Set(d, c::rounder));
  const Vector k = hn::Sub(sum, hn::Set(d, c::rounder));
  Vector r = hn::Sub(y, hn::Mul(k, hn::Set(d, c::pi_high)));
  r = hn::Sub(r, hn::Mul(k, hn::Set(d, c::pi_middle)));
  r = hn::Sub(r, hn::Mul(k, hn::Set(d, c::pi_low)));
  r = hn::BitCast(d, hn::Xor(hn::BitCast(i, r), hn::ShiftLeft<31>(hn::BitCast(i, sum))));
  const auto large = hn::Gt(hn::Abs(x), hn::Set(d, c::near_sine));
  if (HWY_UNLIKELY(!hn::AllFalse(d, large))) r = with_large_angles(x, r);

  // sin r = r + r³ P(r²).
  const Vector r2 = hn::Mul(r, r);
  Vector p = times_plus(hn::Set(d, c::s9), r2, c::s7);
  p = times_plus(p, r2, c::s5);
  p = times_plus(p, r2, c::s3);
  return hn::Add(hn::Mul(hn::Mul(p, r2), r), r);
}

/// |x|, clamped.
HWY_INLINE Vector absolute(Vector x) {
  return min(hn::Abs(x), hn::Set(Floats(), largest_linear));
}

/// x, clamped.
HWY_INLINE Vector identity(Vector x) {
  const Floats d;
  return max(min(x, hn::Set(d, largest_linear)), hn::Set(d, -largest_linear));
}

}  // namespace amble::cppn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggled by HWY_TARGET_TOGGLE
