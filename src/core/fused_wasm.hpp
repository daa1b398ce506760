#pragma once

#include <wasm_simd128.h>

namespace amble {

// a b + c of four floats. Modules differ in which of these they are compiled with, by names of their own.

#if defined(AMBLE_ROUND_PRODUCTS)

/// The product rounded, too: fast everywhere, other bits. To measure by.
inline v128_t fused_in_name(v128_t a, v128_t b, v128_t c) {
  return wasm_f32x4_add(wasm_f32x4_mul(a, b), c);
}
#define AMBLE_FUSED ::amble::fused_in_name

#elif defined(__wasm_relaxed_simd__)

/// WebAssembly's relaxed instruction, which may be fused and is on every processor of the last ten years: a
/// page asks browser::is_fused().
inline v128_t fused_if_so(v128_t a, v128_t b, v128_t c) {
  return wasm_f32x4_relaxed_madd(a, b, c);
}
#define AMBLE_FUSED ::amble::fused_if_so

#else

/// Moves sums that lie halfway between two floats (lanes of `halfway`) off there, towards the exact sum: by
/// the sign of what rounding has lost, as seen from zero.
[[gnu::noinline, gnu::const]] inline v128_t off_halfway(v128_t sum, v128_t product, v128_t addend,
                                                        v128_t halfway) {
  const v128_t part = wasm_f64x2_sub(sum, product);
  const v128_t lost =
      wasm_f64x2_add(wasm_f64x2_sub(product, wasm_f64x2_sub(sum, part)), wasm_f64x2_sub(addend, part));
  const v128_t inexact = wasm_f64x2_ne(lost, wasm_f64x2_const_splat(0.0));
  const v128_t inwards =
      wasm_i64x2_shr(wasm_v128_xor(lost, sum), 63);  // −1 where the sum is too large, else 0
  const v128_t by = wasm_v128_or(inwards, wasm_i64x2_const_splat(1));
  return wasm_i64x2_add(sum, wasm_v128_and(by, wasm_v128_and(inexact, halfway)));
}

/// Rounded once, as core/fused.hpp, four at a time. The product is exact in double. Rounding the sum to
/// double and then to float is rounding once, unless the double lies halfway between two floats.
inline v128_t fused_exactly(v128_t a, v128_t b, v128_t c) {
  const auto upper = [](v128_t v) { return wasm_i64x2_shuffle(v, v, 1, 1); };
  const auto wide = [](v128_t v) { return wasm_f64x2_promote_low_f32x4(v); };
  const v128_t product0 = wasm_f64x2_mul(wide(a), wide(b)),
               product1 = wasm_f64x2_mul(wide(upper(a)), wide(upper(b)));
  const v128_t addend0 = wide(c), addend1 = wide(upper(c));
  v128_t sum0 = wasm_f64x2_add(product0, addend0), sum1 = wasm_f64x2_add(product1, addend1);

  const v128_t below = wasm_i64x2_const_splat(0x1fffffff), half = wasm_i64x2_const_splat(0x10000000);
  const v128_t halfway0 = wasm_i64x2_eq(wasm_v128_and(sum0, below), half);
  const v128_t halfway1 = wasm_i64x2_eq(wasm_v128_and(sum1, below), half);
  if (__builtin_expect(wasm_v128_any_true(wasm_v128_or(halfway0, halfway1)), 0)) {
    sum0 = off_halfway(sum0, product0, addend0, halfway0);
    sum1 = off_halfway(sum1, product1, addend1, halfway1);
  }
  return wasm_i32x4_shuffle(wasm_f32x4_demote_f64x2_zero(sum0), wasm_f32x4_demote_f64x2_zero(sum1), 0, 1, 4,
                            5);
}
#define AMBLE_FUSED ::amble::fused_exactly

#endif

}  // namespace amble
