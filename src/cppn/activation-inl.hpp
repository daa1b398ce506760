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

/// An angle whose sine is sin(2x): 2x less the nearest multiple k π, with the other sign where k is odd. For
/// |x| ≤ near_sine.
HWY_INLINE Vector near_sine_angle(Vector x) {
  const Floats d;
  const Ints i;
  const Vector y = hn::Add(x, x);
  const Vector sum = hn::Add(hn::Mul(y, hn::Set(d, c::one_over_pi)), hn::Set(d, c::rounder));
  const Vector k = hn::Sub(sum, hn::Set(d, c::rounder));
  Vector r = hn::Sub(y, hn::Mul(k, hn::Set(d, c::pi_high)));
  r = hn::Sub(r, hn::Mul(k, hn::Set(d, c::pi_middle)));
  r = hn::Sub(r, hn::Mul(k, hn::Set(d, c::pi_low)));
  return hn::BitCast(d, hn::Xor(hn::BitCast(i, r), hn::ShiftLeft<31>(hn::BitCast(i, sum))));
}

#if HWY_TARGET == HWY_SCALAR || HWY_ARCH_WASM

/// sine_angle_of_large() of lanes with |x| > near_sine, `angle` in all others.
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

#else

using HalfFloats = hn::Half<Floats>;

/// sine_angle_of_large() step by step, of half a vector, because turns have 64 bits. Any angle for lanes with
/// |x| ≤ near_sine.
HWY_INLINE hn::Vec<HalfFloats> large_sine_angle(hn::Vec<HalfFloats> x) {
  const HalfFloats d;
  const hn::RebindToUnsigned<HalfFloats> u32;
  const hn::RebindToSigned<HalfFloats> i32;
  const hn::Rebind<std::uint64_t, HalfFloats> u64;
  const hn::Rebind<std::int64_t, HalfFloats> i64;
  const hn::Rebind<double, HalfFloats> f64;
  const hn::Repartition<std::uint32_t, decltype(u64)> pairs;

  const auto bits = hn::BitCast(u32, hn::Abs(x));
  const auto significand =
      hn::PromoteTo(u64, hn::Or(hn::And(bits, hn::Set(u32, 0x7fffffu)), hn::Set(u32, 0x800000u)));
  const auto exponent =
      hn::Sub(hn::BitCast(i32, hn::ShiftRight<23>(bits)), hn::Set(i32, c::first_large_exponent));
  const auto digits =
      hn::GatherIndex(u64, c::turn_digits.data(), hn::PromoteTo(i64, hn::Max(exponent, hn::Zero(i32))));
  // The low 64 bits of significand × digits, from the halves of the digits.
  const auto low = hn::MulEven(hn::BitCast(pairs, significand), hn::BitCast(pairs, digits));
  const auto high =
      hn::MulEven(hn::BitCast(pairs, significand), hn::BitCast(pairs, hn::ShiftRight<32>(digits)));
  const auto turns = hn::Add(low, hn::ShiftLeft<32>(high));

  // The highest bit is half a turn, and in a double the sign.
  const auto half_turn = hn::Set(u64, std::uint64_t{1} << 63);
  const auto odd = hn::And(hn::Add(turns, hn::ShiftRight<1>(half_turn)), half_turn);
  const auto rest = hn::ConvertTo(f64, hn::BitCast(i64, hn::Xor(turns, odd)));
  const auto angle = hn::Mul(rest, hn::Set(f64, c::turn_unit_rad));
  return hn::Xor(hn::DemoteTo(d, hn::Xor(angle, hn::BitCast(f64, odd))), hn::And(x, hn::Set(d, -0.0f)));
}

/// sine_angle_of_large() of lanes with |x| > near_sine, `angle` in all others.
HWY_NOINLINE Vector with_large_angles(Vector x, Vector angle) {
  const Floats d;
  const HalfFloats half;
  const Vector large =
      hn::Combine(d, large_sine_angle(hn::UpperHalf(half, x)), large_sine_angle(hn::LowerHalf(half, x)));
  return hn::IfThenElse(hn::Gt(hn::Abs(x), hn::Set(d, c::near_sine)), large, angle);
}

#endif

/// sin r = r + r³ P(r²).
HWY_INLINE Vector sine_of_angle(Vector r) {
  const Floats d;
  const Vector r2 = hn::Mul(r, r);
  Vector p = times_plus(hn::Set(d, c::s9), r2, c::s7);
  p = times_plus(p, r2, c::s5);
  p = times_plus(p, r2, c::s3);
  return hn::Add(hn::Mul(hn::Mul(p, r2), r), r);
}

HWY_INLINE bool any_large(Vector absolute_x) {
  const Floats d;
  return !hn::AllFalse(d, hn::Gt(absolute_x, hn::Set(d, c::near_sine)));
}

/// sin(2 x).
HWY_INLINE Vector sine(Vector x) {
  Vector angle = near_sine_angle(x);
  if (HWY_UNLIKELY(any_large(hn::Abs(x)))) angle = with_large_angles(x, angle);
  return sine_of_angle(angle);
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

/// A function of four vectors, each replaced by its values.
template <Vector (*function)(Vector)>
HWY_INLINE void apply_to_four(Vector& v0, Vector& v1, Vector& v2, Vector& v3) {
  v0 = function(v0);
  v1 = function(v1);
  v2 = function(v2);
  v3 = function(v3);
}

/// sin(2 x) of four vectors. They branch once, because a branch for each is often foretold wrongly.
HWY_INLINE void sines_of_four(Vector& v0, Vector& v1, Vector& v2, Vector& v3) {
  const Vector x[4]{v0, v1, v2, v3};
  Vector angle[4];
  for (int i = 0; i < 4; ++i) angle[i] = near_sine_angle(x[i]);
  const Vector largest = max(max(hn::Abs(v0), hn::Abs(v1)), max(hn::Abs(v2), hn::Abs(v3)));
  if (HWY_UNLIKELY(any_large(largest)))
    for (int i = 0; i < 4; ++i) angle[i] = with_large_angles(x[i], angle[i]);
  v0 = sine_of_angle(angle[0]);
  v1 = sine_of_angle(angle[1]);
  v2 = sine_of_angle(angle[2]);
  v3 = sine_of_angle(angle[3]);
}

}  // namespace amble::cppn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggled by HWY_TARGET_TOGGLE
