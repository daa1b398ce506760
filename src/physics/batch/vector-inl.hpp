// Vectors and matrices in three dimensions, one per lane, for each instruction set (core/simd-inl.hpp). A
// product that is added is a fused multiply-add, written out: so every instruction set gives the same bits.
#if defined(AMBLE_BATCH_VECTOR_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef AMBLE_BATCH_VECTOR_INL_HPP
#undef AMBLE_BATCH_VECTOR_INL_HPP
#else
#define AMBLE_BATCH_VECTOR_INL_HPP
#endif

#include "amble/core/simd-inl.hpp"
#include "amble/physics/batch/model.hpp"
#include "amble/physics/batch/state_rows.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::physics::batch::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using simd::HWY_NAMESPACE::Floats;
using simd::HWY_NAMESPACE::fma;
using simd::HWY_NAMESPACE::fnma;
using simd::HWY_NAMESPACE::Ints;
using simd::HWY_NAMESPACE::load;
using simd::HWY_NAMESPACE::Mask;
using simd::HWY_NAMESPACE::max;
using simd::HWY_NAMESPACE::min;
using simd::HWY_NAMESPACE::set;
using simd::HWY_NAMESPACE::store;
using simd::HWY_NAMESPACE::V;
using simd::HWY_NAMESPACE::width;
using simd::HWY_NAMESPACE::zero;
static_assert(lanes % 16 == 0, "a vector holds up to 16 lanes");

HWY_INLINE Mask no_lanes() {
  return hn::MaskFromVec(zero());
}
/// a b − c d, the second product rounded on its own.
HWY_INLINE V difference_of_products(V a, V b, V c, V d) {
  return fnma(c, d, a * b);
}

struct V3 {
  V x, y, z;
};

HWY_INLINE V3 set(Float3 v) {
  return {set(v.x), set(v.y), set(v.z)};
}
HWY_INLINE V3 zero3() {
  return {zero(), zero(), zero()};
}
HWY_INLINE V3 operator+(V3 a, V3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
HWY_INLINE V3 operator-(V3 a, V3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HWY_INLINE V3 operator*(V s, V3 a) {
  return {s * a.x, s * a.y, s * a.z};
}
/// c + s a.
HWY_INLINE V3 fma(V s, V3 a, V3 c) {
  return {fma(s, a.x, c.x), fma(s, a.y, c.y), fma(s, a.z, c.z)};
}
/// c − s a.
HWY_INLINE V3 fnma(V s, V3 a, V3 c) {
  return {fnma(s, a.x, c.x), fnma(s, a.y, c.y), fnma(s, a.z, c.z)};
}
/// c + a · b.
HWY_INLINE V dot(V3 a, V3 b, V c) {
  return fma(a.z, b.z, fma(a.y, b.y, fma(a.x, b.x, c)));
}
HWY_INLINE V dot(V3 a, V3 b) {
  return fma(a.z, b.z, fma(a.y, b.y, a.x * b.x));
}
HWY_INLINE V3 cross(V3 a, V3 b) {
  return {difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
          difference_of_products(a.x, b.y, a.y, b.x)};
}
/// c + a × b.
HWY_INLINE V3 cross(V3 a, V3 b, V3 c) {
  return {fnma(a.z, b.y, fma(a.y, b.z, c.x)), fnma(a.x, b.z, fma(a.z, b.x, c.y)),
          fnma(a.y, b.x, fma(a.x, b.y, c.z))};
}

/// The columns of a 3 × 3 matrix.
struct Columns {
  V3 x, y, z;
};
HWY_INLINE V3 operator*(const Columns& m, V3 v) {
  return fma(v.z, m.z, fma(v.y, m.y, v.x * m.x));
}
/// The transposed matrix times v.
HWY_INLINE V3 transposed(const Columns& m, V3 v) {
  return {dot(m.x, v), dot(m.y, v), dot(m.z, v)};
}

struct Symmetric {
  V xx, yy, zz, xy, xz, yz;
};
HWY_INLINE V3 operator*(const Symmetric& m, V3 v) {
  return {fma(m.xz, v.z, fma(m.xy, v.y, m.xx * v.x)), fma(m.yz, v.z, fma(m.yy, v.y, m.xy * v.x)),
          fma(m.zz, v.z, fma(m.yz, v.y, m.xz * v.x))};
}
HWY_INLINE Symmetric operator+(const Symmetric& a, const Symmetric& b) {
  return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.xz + b.xz, a.yz + b.yz};
}

/// Several consecutive rows of the state, for the lanes of this pass.
HWY_INLINE V3 load3(const Row* rows, int lane) {
  return {load(rows[0].lane.data() + lane), load(rows[1].lane.data() + lane),
          load(rows[2].lane.data() + lane)};
}
HWY_INLINE void store3(V3 v, Row* rows, int lane) {
  store(v.x, rows[0].lane.data() + lane);
  store(v.y, rows[1].lane.data() + lane);
  store(v.z, rows[2].lane.data() + lane);
}
HWY_INLINE V load1(const Row& row, int lane) {
  return load(row.lane.data() + lane);
}
HWY_INLINE void store1(V v, Row& row, int lane) {
  store(v, row.lane.data() + lane);
}

}  // namespace amble::physics::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggled by HWY_TARGET_TOGGLE
