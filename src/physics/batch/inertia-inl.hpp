// The mass matrix by the composite rigid body algorithm, and the base's velocity; for each instruction set.
//
// Spatial vectors are those of Featherstone 2008 (ch. 2), all about the robot's centre of mass in torso axes.
// A body of mass m, centre c and tensor I_c has there the inertia I = I_c + m (c·c 1 − c cᵀ) (kg m²) and the
// first moment h = m c (kg m), and maps (ω, v) to the momentum (I ω + h × v, m v − h × ω) (sec. 2.12, 2.13).
#if defined(AMBLE_BATCH_INERTIA_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef AMBLE_BATCH_INERTIA_INL_HPP
#undef AMBLE_BATCH_INERTIA_INL_HPP
#else
#define AMBLE_BATCH_INERTIA_INL_HPP
#endif

#include "amble/physics/batch/pose-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::physics::batch::HWY_NAMESPACE {

/// A spatial vector: angular and linear velocity (rad/s, m/s), torque and force (N m, N), angular and linear
/// momentum (kg m²/s, kg m/s) or impulse.
struct Spatial {
  V3 angular, linear;
};

HWY_INLINE Spatial zero_spatial() {
  return {zero3(), zero3()};
}
HWY_INLINE Spatial operator+(const Spatial& a, const Spatial& b) {
  return {a.angular + b.angular, a.linear + b.linear};
}
HWY_INLINE Spatial fma(V s, const Spatial& a, const Spatial& c) {
  return {fma(s, a.angular, c.angular), fma(s, a.linear, c.linear)};
}
HWY_INLINE V dot(const Spatial& a, const Spatial& b) {
  return dot(a.linear, b.linear, dot(a.angular, b.angular));
}

/// Quantities of the floating base, the torso with all chains as they are in this step.
struct Base {
  Symmetric inertia;  ///< composite, of the robot: with its mass, M_bb
  Symmetric inverse_inertia;
  Symmetric torso_inertia;  ///< of the torso alone, and its first moment
  V3 torso_first_moment;
  Spatial joint_momentum;     ///< Σ M_bq,j q̇_j: what the joints' speeds contribute
  Spatial velocity;           ///< of the torso, at the centre of mass
  Spatial bias_acceleration;  ///< of the torso, without any force and with q̈ = 0
};

/// Vectors to reserve for a chain of N joints; N = −1: the length is known at run time only.
template <int N>
constexpr int capacity = N >= 0 ? N : Model::max_chain;
template <int N>
HWY_INLINE int length(const Chain& chain) {
  return N >= 0 ? N : chain.count;
}
/// The link's parent in its chain, −1: the torso. Chains of N links do not branch.
template <int N>
HWY_INLINE int parent_of(const Link& link, int j) {
  return N >= 0 ? j - 1 : link.parent;
}
/// Index of an entry of a lower triangle that is stored row by row.
constexpr int triangle(int row, int column) {
  return row * (row + 1) / 2 + column;
}

/// The joint's motion subspace S_j = (a, c × a), with axis a through c: velocity per unit of its speed.
HWY_INLINE Spatial motion_subspace(const Pass& pass, const Chain& chain, int j) {
  const int row = pass.pose_row(chain.first + j);
  return {pass.state3(row + 12), pass.state3(row + 15)};
}

/// Inertia of a body about the robot's centre of mass, R I_c Rᵀ + m (c·c 1 − c cᵀ), with R = `axes` and
/// c = `arm` (parallel axes; Featherstone 2008, eq. 2.63).
HWY_INLINE Symmetric rotational_inertia(const MassPart& body, const Columns& axes, V3 arm) {
  const Float3 m = body.moments_kg_m2, p = body.products_kg_m2;
  // t = R I_c, by column.
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

HWY_INLINE void store_inertia(const Symmetric& inertia, V3 first_moment, float* to) {
  const V all[9] = {inertia.xx, inertia.yy,     inertia.zz,     inertia.xy,    inertia.xz,
                    inertia.yz, first_moment.x, first_moment.y, first_moment.z};
  for (int i = 0; i < 9; ++i) store(all[i], to + i * width);
}
HWY_INLINE Symmetric load_inertia(const float* from) {
  return {load(from),
          load(from + width),
          load(from + 2 * width),
          load(from + 3 * width),
          load(from + 4 * width),
          load(from + 5 * width)};
}
HWY_INLINE V3 load_first_moment(const float* from) {
  return {load(from + 6 * width), load(from + 7 * width), load(from + 8 * width)};
}

HWY_INLINE void store_spatial(const Spatial& s, float* to) {
  const V all[6] = {s.angular.x, s.angular.y, s.angular.z, s.linear.x, s.linear.y, s.linear.z};
  for (int i = 0; i < 6; ++i) store(all[i], to + i * width);
}
HWY_INLINE Spatial load_spatial(const float* from) {
  return {{load(from), load(from + width), load(from + 2 * width)},
          {load(from + 3 * width), load(from + 4 * width), load(from + 5 * width)}};
}

/// Composite rigid body algorithm for one chain, from the tip inwards (Featherstone 2008, sec. 6.2). In a
/// common frame composite inertias are plain sums:
///   I^c_j = I_j + Σ I^c_child,   F_j = I^c_j S_j,   M_ij = S_iᵀ F_j for all i that carry j,   M_bj = F_j,
/// and M_ij = 0 where neither carries the other. The diagonal also has the armature, and h × damping: so
/// damping acts on the speed at the end of the step (unconstrained_chain()).
/// Keeps each link's own inertia and F_j, and writes the triangle M_cc where factorise_chain() expects it.
/// Adds the chain to the base's inertia and to the joints' momentum.
template <int N>
HWY_INLINE void chain_mass_matrix(const Pass& pass, std::size_t c, Base& base) {
  const Chain& chain = pass.model().chains[c];
  const int n = length<N>(chain);
  float* const block = pass.scratch(pass.work().factors[c]);
  // Composite inertias and first moments; those of what a link carries are added before its own.
  const V none = zero();
  Symmetric inertia[capacity<N>];
  V3 first_moment[capacity<N>];
  for (int j = 0; j < n; ++j) {
    inertia[j] = {none, none, none, none, none, none};
    first_moment[j] = zero3();
  }
  for (int j = n - 1; j >= 0; --j) {
    const Link& link = pass.link(chain, j);
    const int row = pass.pose_row(chain.first + j), parent = parent_of<N>(link, j);
    if (link.has_mass) {
      const Columns axes{pass.state3(row), pass.state3(row + 3), pass.state3(row + 6)};
      const V3 arm = pass.state3(row + 9) + axes * set(link.body.com_m);
      const Symmetric own = rotational_inertia(link.body, axes, arm);
      const V3 own_first_moment = set(link.body.mass_kg) * arm;
      store_inertia(own, own_first_moment, pass.scratch(pass.work().link_inertia + 9 * (chain.first + j)));
      inertia[j] = inertia[j] + own;
      first_moment[j] = first_moment[j] + own_first_moment;
    }
    const Spatial subspace = motion_subspace(pass, chain, j);
    // F_j = (I ω + h × v, m v + ω × h) with (ω, v) = S_j.
    const Spatial column{inertia[j] * subspace.angular + cross(first_moment[j], subspace.linear),
                         cross(subspace.angular, first_moment[j], set(link.outer_mass_kg) * subspace.linear)};
    store_spatial(column, pass.scratch(pass.work().base_column + 6 * (chain.first + j)));
    base.joint_momentum = fma(pass.state(pass.rows().speed + chain.first + j), column, base.joint_momentum);
    if constexpr (N < 0)
      for (int i = 0; i < j; ++i) store(none, block + triangle(j, i) * width);
    const V added = set(link.armature_kg_m2 + pass.timestep_s() * link.damping_nm_s_per_rad);
    store(dot(subspace, column) + added, block + triangle(j, j) * width);
    for (int i = parent; i >= 0; i = parent_of<N>(pass.link(chain, i), i))
      store(dot(motion_subspace(pass, chain, i), column), block + triangle(j, i) * width);
    if (parent >= 0) {
      inertia[parent] = inertia[parent] + inertia[j];
      first_moment[parent] = first_moment[parent] + first_moment[j];
    } else {
      base.inertia = base.inertia + inertia[j];
    }
  }
}

/// By the adjugate: m⁻¹ = adj(m) / det(m).
HWY_INLINE Symmetric inverse(const Symmetric& m) {
  const Symmetric minors{
      difference_of_products(m.yy, m.zz, m.yz, m.yz), difference_of_products(m.xx, m.zz, m.xz, m.xz),
      difference_of_products(m.xx, m.yy, m.xy, m.xy), difference_of_products(m.xz, m.yz, m.xy, m.zz),
      difference_of_products(m.xy, m.yz, m.xz, m.yy), difference_of_products(m.xy, m.xz, m.yz, m.xx)};
  const V scale = set(1.0f) / fma(m.xz, minors.xz, fma(m.xy, minors.xy, m.xx * minors.xx));
  return {scale * minors.xx, scale * minors.yy, scale * minors.zz,
          scale * minors.xy, scale * minors.xz, scale * minors.yz};
}

/// The mass matrix, and the base's velocity from the robot's momentum. About the centre of mass M_bb is
/// diag(I, m 1), so
///   ω = I⁻¹ (L − Σ n_j q̇_j),   v = v_com − (Σ f_j q̇_j) / m,   (n_j, f_j) = F_j
/// (Featherstone 2008, sec. 2.12; docs/BATCH.md, "State and coordinates").
template <int N>
HWY_NOINLINE Base mass_matrix(const Pass pass) {
  const Model& model = pass.model();
  Base base;
  const V one = set(1.0f), none = zero();
  const V3 arm = pass.state3(StateRows::torso_origin) + set(model.torso.com_m);
  base.torso_first_moment = set(model.torso.mass_kg) * arm;
  base.torso_inertia =
      rotational_inertia(model.torso, {{one, none, none}, {none, one, none}, {none, none, one}}, arm);
  base.inertia = base.torso_inertia;
  base.joint_momentum = zero_spatial();
  for (std::size_t c = 0; c < model.chains.size(); ++c) chain_mass_matrix<N>(pass, c, base);
  base.inverse_inertia = inverse(base.inertia);
  const Columns world = pass.world();
  base.velocity.angular =
      base.inverse_inertia * (world * pass.state3(StateRows::angular_momentum) - base.joint_momentum.angular);
  base.velocity.linear =
      fnma(set(1.0f / model.mass_kg), base.joint_momentum.linear, world * pass.state3(StateRows::velocity));
  return base;
}

}  // namespace amble::physics::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggled by HWY_TARGET_TOGGLE
