// The mass matrix (composite rigid body algorithm) and the base's velocity, for each instruction set.
#if defined(AMBLE_BATCH_INERTIA_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef AMBLE_BATCH_INERTIA_INL_HPP
#undef AMBLE_BATCH_INERTIA_INL_HPP
#else
#define AMBLE_BATCH_INERTIA_INL_HPP
#endif

#include "amble/physics/batch/pose-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::physics::batch::HWY_NAMESPACE {

/// A motion or a force about the robot's centre of mass, torso axes: angular velocity and velocity, or torque
/// and force, or angular and linear momentum.
struct Spatial {
  V3 turn, push;
};

HWY_INLINE Spatial no_spatial() {
  return {zero3(), zero3()};
}
HWY_INLINE Spatial operator+(const Spatial& a, const Spatial& b) {
  return {a.turn + b.turn, a.push + b.push};
}
HWY_INLINE Spatial fma(V s, const Spatial& a, const Spatial& c) {
  return {fma(s, a.turn, c.turn), fma(s, a.push, c.push)};
}
HWY_INLINE V dot(const Spatial& a, const Spatial& b) {
  return dot(a.push, b.push, dot(a.turn, b.turn));
}

/// What the base (the torso and all that hangs on it) is made of in this step.
struct Base {
  Symmetric inertia;       ///< of the robot about its centre of mass, torso axes
  Symmetric inverse;       ///< of `inertia`
  Symmetric torso_second;  ///< the torso's own, and its first moment
  V3 torso_first;
  Spatial moved;   ///< momentum that the joints' speeds give
  Spatial motion;  ///< velocity of the torso, at the centre of mass
  Spatial drift;   ///< how `motion` would change per second without any force
};

/// How many vectors of a compile-time length N; −1: known at run time only.
template <int N>
constexpr int capacity = N >= 0 ? N : Model::max_chain;
template <int N>
HWY_INLINE int length(const Chain& chain) {
  return N >= 0 ? N : chain.count;
}
constexpr int triangle(int row, int column) {
  return row * (row + 1) / 2 + column;
}

/// The joint's motion per unit of speed.
HWY_INLINE Spatial joint_motion(const Pass& pass, const Chain& chain, int j) {
  const int row = pass.pose_row(chain.first + j);
  return {pass.state3(row + 12), pass.state3(row + 15)};
}

/// Second moment about the robot's centre of a body with its tensor turned by `axes` and centre at `arm`.
HWY_INLINE Symmetric second_moment(const MassPart& body, const Columns& axes, V3 arm) {
  const Float3 m = body.moments_kg_m2, p = body.products_kg_m2;
  // axes · tensor, by column.
  Columns t{set(m.x) * axes.x, set(m.y) * axes.y, set(m.z) * axes.z};
  if (p.x != 0.0f || p.y != 0.0f || p.z != 0.0f) {
    t.x = fma(set(p.y), axes.z, fma(set(p.x), axes.y, t.x));
    t.y = fma(set(p.z), axes.z, fma(set(p.x), axes.x, t.y));
    t.z = fma(set(p.z), axes.y, fma(set(p.y), axes.x, t.z));
  }
  const V3 q = set(body.mass_kg) * arm;
  const V xx = q.x * arm.x, yy = q.y * arm.y, zz = q.z * arm.z;
  const auto entry = [&](V3 a, V3 b, V start)
                         HWY_ATTR { return fma(a.z, b.z, fma(a.y, b.y, fma(a.x, b.x, start))); };
  const V3 tx{t.x.x, t.y.x, t.z.x}, ty{t.x.y, t.y.y, t.z.y}, tz{t.x.z, t.y.z, t.z.z};
  const V3 ax{axes.x.x, axes.y.x, axes.z.x}, ay{axes.x.y, axes.y.y, axes.z.y},
      az{axes.x.z, axes.y.z, axes.z.z};
  return {entry(tx, ax, yy + zz),
          entry(ty, ay, xx + zz),
          entry(tz, az, xx + yy),
          entry(tx, ay, hn::Neg(q.x * arm.y)),
          entry(tx, az, hn::Neg(q.x * arm.z)),
          entry(ty, az, hn::Neg(q.y * arm.z))};
}

HWY_INLINE void store_inertia(const Symmetric& second, V3 first, float* to) {
  const V all[9] = {second.xx, second.yy, second.zz, second.xy, second.xz,
                    second.yz, first.x,   first.y,   first.z};
  for (int i = 0; i < 9; ++i) store(all[i], to + i * width);
}
HWY_INLINE Symmetric load_second(const float* from) {
  return {load(from),
          load(from + width),
          load(from + 2 * width),
          load(from + 3 * width),
          load(from + 4 * width),
          load(from + 5 * width)};
}
HWY_INLINE V3 load_first(const float* from) {
  return {load(from + 6 * width), load(from + 7 * width), load(from + 8 * width)};
}

HWY_INLINE void store_spatial(const Spatial& s, float* to) {
  const V all[6] = {s.turn.x, s.turn.y, s.turn.z, s.push.x, s.push.y, s.push.z};
  for (int i = 0; i < 6; ++i) store(all[i], to + i * width);
}
HWY_INLINE Spatial load_spatial(const float* from) {
  return {{load(from), load(from + width), load(from + 2 * width)},
          {load(from + 3 * width), load(from + 4 * width), load(from + 5 * width)}};
}

/// Own inertia of each link, columns of the mass matrix, and the chain's own block of it, from the tip
/// inwards (Featherstone 2008, sec. 6.2).
template <int N>
HWY_INLINE void weigh_chain(const Pass& pass, std::size_t c, Base& base) {
  const Chain& chain = pass.model().chains[c];
  const int n = length<N>(chain);
  float* const block = pass.scratch(pass.work().factors[c]);
  Symmetric second{zero(), zero(), zero(), zero(), zero(), zero()};
  V3 first = zero3();
  for (int j = n - 1; j >= 0; --j) {
    const Link& link = pass.link(chain, j);
    const int row = pass.pose_row(chain.first + j);
    if (link.has_mass) {
      const Columns axes{pass.state3(row), pass.state3(row + 3), pass.state3(row + 6)};
      const V3 arm = pass.state3(row + 9) + axes * set(link.body.com_m);
      const Symmetric own = second_moment(link.body, axes, arm);
      const V3 own_first = set(link.body.mass_kg) * arm;
      store_inertia(own, own_first, pass.scratch(pass.work().inertia + 9 * (chain.first + j)));
      second = second + own;
      first = first + own_first;
    }
    const Spatial motion = joint_motion(pass, chain, j);
    const Spatial column{second * motion.turn + cross(first, motion.push),
                         cross(motion.turn, first, set(link.outer_mass_kg) * motion.push)};
    store_spatial(column, pass.scratch(pass.work().columns + 6 * (chain.first + j)));
    base.moved = fma(pass.state(pass.batch.rows.speed + chain.first + j), column, base.moved);
    for (int i = 0; i <= j; ++i)
      store(dot(joint_motion(pass, chain, i), column), block + triangle(j, i) * width);
  }
  base.inertia = base.inertia + second;
}

HWY_INLINE Symmetric inverse(const Symmetric& m) {
  const Symmetric minors{
      difference_of_products(m.yy, m.zz, m.yz, m.yz), difference_of_products(m.xx, m.zz, m.xz, m.xz),
      difference_of_products(m.xx, m.yy, m.xy, m.xy), difference_of_products(m.xz, m.yz, m.xy, m.zz),
      difference_of_products(m.xy, m.yz, m.xz, m.yy), difference_of_products(m.xy, m.xz, m.yz, m.xx)};
  const V scale = set(1.0f) / fma(m.xz, minors.xz, fma(m.xy, minors.xy, m.xx * minors.xx));
  return {scale * minors.xx, scale * minors.yy, scale * minors.zz,
          scale * minors.xy, scale * minors.xz, scale * minors.yz};
}

/// The mass matrix, and the base's velocity from the robot's momentum.
template <int N>
HWY_NOINLINE Base weigh(const Pass& pass) {
  const Model& model = pass.model();
  Base base;
  const V one = set(1.0f), none = zero();
  const V3 arm = pass.state3(Rows::origin) + set(model.torso.com_m);
  base.torso_first = set(model.torso.mass_kg) * arm;
  base.torso_second =
      second_moment(model.torso, {{one, none, none}, {none, one, none}, {none, none, one}}, arm);
  base.inertia = base.torso_second;
  base.moved = no_spatial();
  for (std::size_t c = 0; c < model.chains.size(); ++c) weigh_chain<N>(pass, c, base);
  base.inverse = inverse(base.inertia);
  const Columns world = pass.world();
  base.motion.turn = base.inverse * (world * pass.state3(Rows::spin) - base.moved.turn);
  base.motion.push = fnma(set(1.0f / model.mass_kg), base.moved.push, world * pass.state3(Rows::velocity));
  return base;
}

}  // namespace amble::physics::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggled by HWY_TARGET_TOGGLE
