// Vectors of float32, for each instruction set: included once per target through Highway's foreach_target, by
// folders that link Highway. Every operation is one that IEEE 754 rounds correctly, and a product that is
// added is a fused multiply-add, written out: so every instruction set gives the same bits.
#if defined(AMBLE_CORE_SIMD_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef AMBLE_CORE_SIMD_INL_HPP
#undef AMBLE_CORE_SIMD_INL_HPP
#else
#define AMBLE_CORE_SIMD_INL_HPP
#endif

#include <hwy/highway.h>

#include "amble/core/fused.hpp"
#if HWY_ARCH_WASM
#include "amble/core/fused_wasm.hpp"
#endif

HWY_BEFORE_NAMESPACE();
namespace amble::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// As many lanes as the machine has, up to 16.
using Floats = hn::CappedTag<float, 16>;
using Ints = hn::RebindToSigned<Floats>;
using V = hn::Vec<Floats>;
using Mask = hn::Mask<Floats>;
constexpr int width = static_cast<int>(hn::MaxLanes(Floats()));

HWY_INLINE V set(float x) {
  return hn::Set(Floats(), x);
}
HWY_INLINE V zero() {
  return hn::Zero(Floats());
}
/// `from` and `to` are aligned to the vector.
HWY_INLINE V load(const float* from) {
  return hn::Load(Floats(), from);
}
HWY_INLINE void store(V v, float* to) {
  hn::Store(v, Floats(), to);
}

/// a b + c, rounded once.
HWY_INLINE V fma(V a, V b, V c) {
#if HWY_NATIVE_FMA
  return hn::MulAdd(a, b, c);
#elif HWY_ARCH_WASM
  return V{AMBLE_FUSED(a.raw, b.raw, c.raw)};
#else
  HWY_ALIGN float as[width], bs[width], cs[width];
  store(a, as);
  store(b, bs);
  store(c, cs);
  for (int i = 0; i < width; ++i) cs[i] = fused(as[i], bs[i], cs[i]);
  return load(cs);
#endif
}

/// a b − c, rounded once.
HWY_INLINE V fms(V a, V b, V c) {
#if HWY_NATIVE_FMA
  return hn::MulSub(a, b, c);
#else
  return fma(a, b, hn::Neg(c));
#endif
}

/// c − a b, rounded once.
HWY_INLINE V fnma(V a, V b, V c) {
#if HWY_NATIVE_FMA
  return hn::NegMulAdd(a, b, c);
#else
  return fma(hn::Neg(a), b, c);
#endif
}

/// a < b ? a : b, as x86 has it, whatever the signs of zeros, and NaN among them. NEON's own minimum takes −0
/// for less than +0, and the number where one is NaN.
HWY_INLINE V min(V a, V b) {
#if HWY_ARCH_X86
  return hn::Min(a, b);
#else
  return hn::IfThenElse(hn::Lt(a, b), a, b);
#endif
}

/// a > b ? a : b, the same.
HWY_INLINE V max(V a, V b) {
#if HWY_ARCH_X86
  return hn::Max(a, b);
#else
  return hn::IfThenElse(hn::Gt(a, b), a, b);
#endif
}

}  // namespace amble::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggled by HWY_TARGET_TOGGLE
