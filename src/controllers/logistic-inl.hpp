// The logistic function on one vector, for each instruction set: included once per target through Highway's
// foreach_target. Products are added by fused multiply-add, written out, and nothing is approximate beyond
// rounding and the polynomial: so every instruction set gives the same bits.
#if defined(AMBLE_CONTROLLERS_LOGISTIC_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef AMBLE_CONTROLLERS_LOGISTIC_INL_HPP
#undef AMBLE_CONTROLLERS_LOGISTIC_INL_HPP
#else
#define AMBLE_CONTROLLERS_LOGISTIC_INL_HPP
#endif

#include "amble/controllers/logistic_constants.hpp"
#include "amble/core/simd-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::controllers::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace c = constants;

using simd::HWY_NAMESPACE::Floats;
using simd::HWY_NAMESPACE::fma;
using simd::HWY_NAMESPACE::fms;
using simd::HWY_NAMESPACE::Ints;
using simd::HWY_NAMESPACE::load;
using simd::HWY_NAMESPACE::max;
using simd::HWY_NAMESPACE::min;
using simd::HWY_NAMESPACE::set;
using simd::HWY_NAMESPACE::store;
using simd::HWY_NAMESPACE::V;
using simd::HWY_NAMESPACE::width;
using simd::HWY_NAMESPACE::zero;

/// s(x) = 1/(1 + e^(−slope x)). Once for many vectors, what depends on the slope alone.
class Logistic {
 public:
  explicit HWY_INLINE Logistic(float slope)
      : scale_(set(-(slope * c::log2_e))), largest_(set(c::largest_exponent / (slope * c::log2_e))) {}

  HWY_INLINE V operator()(V x) const {
    V one[1] = {x};
    replace(one);
    return one[0];
  }

  /// Several at once, step by step, so that one's operations fill the gaps between another's.
  /// With k + r = −slope log2(e) x, k whole: e^(−slope x) = 2^k 2^r.
  template <int count>
  HWY_INLINE void replace(V (&x)[count]) const {
    const Ints i;
    const V rounder = set(c::rounder), low = hn::Neg(largest_);
    V sum[count], r[count], p[count];
    for (int n = 0; n < count; ++n) x[n] = max(min(x[n], largest_), low);
    for (int n = 0; n < count; ++n) sum[n] = fma(x[n], scale_, rounder);
    for (int n = 0; n < count; ++n) r[n] = fms(x[n], scale_, hn::Sub(sum[n], rounder));
    for (int n = 0; n < count; ++n) p[n] = fma(set(c::e5), r[n], set(c::e4));
    for (const float factor : {c::e3, c::e2, c::e1, c::e0})
      for (int n = 0; n < count; ++n) p[n] = fma(p[n], r[n], set(factor));
    // The low bits of `sum` are k; shifted up they are added to the exponent of p.
    for (int n = 0; n < count; ++n)
      p[n] = hn::BitCast(Floats(), hn::Add(hn::BitCast(i, p[n]), hn::ShiftLeft<23>(hn::BitCast(i, sum[n]))));
    for (int n = 0; n < count; ++n) x[n] = hn::Div(set(1.0f), hn::Add(set(1.0f), p[n]));
  }

 private:
  V scale_, largest_;
};

}  // namespace amble::controllers::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggled by HWY_TARGET_TOGGLE
