// Factorisation of the mass matrix, M = L Lᵀ, and the velocity without constraints; for each instruction set.
//
// With the joints of each chain first and the base last, M is a block arrow (branch-induced sparsity,
// Featherstone 2008, sec. 6.4), and L has no fill-in: for each chain c a triangle L_c and six rows B_c for
// the base, and a triangle L_b of the base itself,
//   L_c L_cᵀ = M_cc,   B_c L_cᵀ = M_bc,   L_b L_bᵀ = M_bb − Σ B_c B_cᵀ.
// The solver works on the mass-normalised velocity u = Lᵀ ν, of which ½ uᵀ u is the kinetic energy. There one
// vector W = L⁻¹ Jᵀ both measures a constraint's velocity, J ν = Wᵀ u, and applies its impulse, Δu = W p.
#if defined(AMBLE_BATCH_FACTOR_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef AMBLE_BATCH_FACTOR_INL_HPP
#undef AMBLE_BATCH_FACTOR_INL_HPP
#else
#define AMBLE_BATCH_FACTOR_INL_HPP
#endif

#include "amble/physics/batch/forces-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::physics::batch::HWY_NAMESPACE {

/// L_b and the inverses of its diagonal; before factorisation `lower` is the Schur complement M_bb − Σ B_c
/// B_cᵀ. Rows in the order of Spatial, angular before linear.
struct BaseFactor {
  V lower[21];
  V inverse[6];
};

/// A chain's factor in the scratch memory.
struct ChainFactor {
  float* data;
  int n;

  /// L_c; the inverses of its diagonal; the six entries of B_c in the column of a joint.
  float* lower(int row, int column) const { return data + triangle(row, column) * width; }
  float* inverse(int row) const { return data + (n * (n + 1) / 2 + row) * width; }
  float* base(int joint) const { return data + (n * (n + 3) / 2 + 6 * joint) * width; }
};

HWY_INLINE void to_array(const Spatial& s, V* values) {
  values[0] = s.angular.x;
  values[1] = s.angular.y;
  values[2] = s.angular.z;
  values[3] = s.linear.x;
  values[4] = s.linear.y;
  values[5] = s.linear.z;
}

/// Cholesky factorisation of a lower triangle, in place: l_ij = (m_ij − Σ_k<j l_ik l_jk) / l_jj and
/// l_ii = √(m_ii − Σ_k<i l_ik²).
template <int cap>
HWY_INLINE void factorise(V* lower, V* inverse, int n) {
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j <= i; ++j) {
      V sum = lower[triangle(i, j)];
      for (int k = 0; k < j; ++k) sum = fnma(lower[triangle(i, k)], lower[triangle(j, k)], sum);
      if (i == j) {
        lower[triangle(i, i)] = hn::Sqrt(sum);
        inverse[i] = set(1.0f) / lower[triangle(i, i)];
      } else {
        lower[triangle(i, j)] = sum * inverse[j];
      }
    }
  }
}

/// x ← L_b⁻¹ x by forward substitution; entries before `first` are 0.
HWY_INLINE void solve_base(const BaseFactor& factor, V* x, int first = 0) {
  for (int i = first; i < 6; ++i) {
    for (int k = first; k < i; ++k) x[i] = fnma(factor.lower[triangle(i, k)], x[k], x[i]);
    x[i] = x[i] * factor.inverse[i];
  }
}
/// x ← L_b⁻ᵀ x by back substitution.
HWY_INLINE void solve_base_transposed(const BaseFactor& factor, V* x) {
  for (int i = 5; i >= 0; --i) {
    for (int k = i + 1; k < 6; ++k) x[i] = fnma(factor.lower[triangle(k, i)], x[k], x[i]);
    x[i] = x[i] * factor.inverse[i];
  }
}

/// L_c and B_c of a chain; subtracts B_c B_cᵀ from the base's Schur complement.
template <int N>
HWY_INLINE ChainFactor factorise_chain(const Pass& pass, std::size_t c, BaseFactor& base) {
  const Chain& chain = pass.model().chains[c];
  const int n = length<N>(chain);
  const ChainFactor factor{pass.scratch(pass.work().factors[c]), n};
  V lower[capacity<N> * (capacity<N> + 1) / 2], inverse[capacity<N>], rows[capacity<N>][6];
  for (int i = 0; i < n * (n + 1) / 2; ++i) lower[i] = load(factor.data + i * width);
  factorise<capacity<N>>(lower, inverse, n);
  // B_c = M_bc L_c⁻ᵀ, joint by joint.
  for (int j = 0; j < n; ++j) {
    to_array(load_spatial(pass.scratch(pass.work().base_column + 6 * (chain.first + j))), rows[j]);
    for (int d = 0; d < 6; ++d) {
      for (int k = 0; k < j; ++k) rows[j][d] = fnma(lower[triangle(j, k)], rows[k][d], rows[j][d]);
      rows[j][d] = rows[j][d] * inverse[j];
      store(rows[j][d], factor.base(j) + d * width);
    }
    for (int d = 0; d < 6; ++d)
      for (int e = 0; e <= d; ++e)
        base.lower[triangle(d, e)] = fnma(rows[j][d], rows[j][e], base.lower[triangle(d, e)]);
  }
  for (int i = 0; i < n * (n + 1) / 2; ++i) store(lower[i], factor.data + i * width);
  for (int j = 0; j < n; ++j) store(inverse[j], factor.inverse(j));
  return factor;
}

/// The joints' entries of u after a step without constraints, in place of their bias forces:
///   u_c = L_cᵀ q̇ + B_cᵀ (ν_b + h g) + y_c,   y_c = h L_c⁻¹ (τ − C_q − M_qb a_b),
/// a_b being the base's bias acceleration, which enters nowhere else: the base's next velocity follows from
/// the momentum. Adds B_c y_c to `reaction`, what the chain's torques exert on the base.
template <int N>
HWY_INLINE void unconstrained_chain(const Pass& pass, const LaneArray& targets_rad, std::size_t c,
                                    const ChainFactor& factor, const Base& base, const V* base_velocity,
                                    V* reaction) {
  const Chain& chain = pass.model().chains[c];
  const int n = length<N>(chain);
  const V h = set(pass.timestep_s());
  V speed[capacity<N>], y[capacity<N>];
  for (int j = 0; j < n; ++j) speed[j] = pass.state(pass.rows().speed + chain.first + j);
  for (int j = 0; j < n; ++j) {
    const int index = chain.first + j;
    float* const row = pass.scratch(pass.work().u_joints + index);
    const Spatial column = load_spatial(pass.scratch(pass.work().base_column + 6 * index));
    float* const joint_row = pass.joint_row(chain, j);
    const V torque = apply_servo(pass, targets_rad, pass.link(chain, j), index, joint_row);
    store(torque, joint_row + 3 * width);
    // Forward substitution of y, and the rows of L_cᵀ and B_cᵀ.
    V x = h * (torque - (load(row) + dot(column, base.bias_acceleration)));
    for (int k = 0; k < j; ++k) x = fnma(load(factor.lower(j, k)), y[k], x);
    y[j] = x * load(factor.inverse(j));
    V sum = y[j];
    for (int i = j; i < n; ++i) sum = fma(load(factor.lower(i, j)), speed[i], sum);
    for (int d = 0; d < 6; ++d) {
      const V b = load(factor.base(j) + d * width);
      sum = fma(b, base_velocity[d], sum);
      reaction[d] = fma(b, y[j], reaction[d]);
    }
    store(sum, row);
  }
  for (int r = n; r < chain.row_count; ++r)
    apply_friction(pass, pass.link(chain, pass.row_of(chain, r).link), pass.joint_row(chain, r));
}

/// Factorises M, and computes u = Lᵀ ν after a step without constraints. Base: with gravity g (which
/// accelerates the whole robot alike and is in no bias force) and the push's impulse p_b,
///   u_b = L_bᵀ (ν_b + h g) + L_b⁻¹ (p_b − Σ B_c y_c).
template <int N>
HWY_NOINLINE void unconstrained_velocity(const Pass pass, const LaneArray& targets_rad, const Base& base,
                                         BaseFactor& factor, V* u_base) {
  const Model& model = pass.model();
  // M_bb = diag(I, m 1), its lower triangle row by row.
  const Symmetric& m = base.inertia;
  const V none = zero(), mass = set(model.mass_kg);
  const V start[21] = {m.xx, m.xy, m.yy, m.xz, m.yz, m.zz, none, none, none, mass, none,
                       none, none, none, mass, none, none, none, none, none, mass};
  for (int i = 0; i < 21; ++i) factor.lower[i] = start[i];
  V velocity[6], reaction[6];
  const V3 gravity_change = set(pass.timestep_s()) * (pass.world() * set(model.gravity_m_s2));
  to_array({base.velocity.angular, base.velocity.linear + gravity_change}, velocity);
  for (V& r : reaction) r = none;
  for (std::size_t c = 0; c < model.chains.size(); ++c) {
    const ChainFactor chain = factorise_chain<N>(pass, c, factor);
    unconstrained_chain<N>(pass, targets_rad, c, chain, base, velocity, reaction);
  }
  factorise<6>(factor.lower, factor.inverse, 6);
  // The push acts at the torso's centre of mass r: p_b = (r × p, p).
  const V3 impulse = pass.world() * pass.state3(StateRows::push_impulse);
  V push[6];
  to_array({cross(pass.state3(StateRows::torso_origin) + set(model.torso.com_m), impulse), impulse}, push);
  for (int d = 0; d < 6; ++d) reaction[d] = reaction[d] - push[d];
  solve_base(factor, reaction);
  for (int d = 0; d < 6; ++d) {
    V sum = hn::Neg(reaction[d]);
    for (int e = d; e < 6; ++e) sum = fma(factor.lower[triangle(e, d)], velocity[e], sum);
    u_base[d] = sum;
  }
}

}  // namespace amble::physics::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggled by HWY_TARGET_TOGGLE
