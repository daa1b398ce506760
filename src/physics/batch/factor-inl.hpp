// Factorisation of the mass matrix and the velocities without constraints, for each instruction set.
//
// Joints of a chain first, base last, the mass matrix is a block arrow; its factor L has for each chain c a
// triangle L_c and six rows B_c for the base, and a triangle L_b of the base itself:
//   L_c L_cᵀ = M_cc,   B_c L_cᵀ = M_bc,   L_b L_bᵀ = M_bb − Σ B_c B_cᵀ.
// The solver works on Lᵀ ν, where a constraint's effect and its measurement are the same vector L⁻¹ Jᵀ.
#if defined(AMBLE_BATCH_FACTOR_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef AMBLE_BATCH_FACTOR_INL_HPP
#undef AMBLE_BATCH_FACTOR_INL_HPP
#else
#define AMBLE_BATCH_FACTOR_INL_HPP
#endif

#include "amble/physics/batch/forces-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::physics::batch::HWY_NAMESPACE {

/// L_b, first as what is left of M_bb, and the inverses of its diagonal. Turning before pushing.
struct BaseFactor {
  V lower[21];
  V inverse[6];
};

/// Where a chain's factor stands in the scratch memory.
struct ChainFactor {
  float* at;
  int n;

  float* lower(int row, int column) const { return at + triangle(row, column) * width; }
  float* inverse(int row) const { return at + (n * (n + 1) / 2 + row) * width; }
  float* base(int joint) const { return at + (n * (n + 3) / 2 + 6 * joint) * width; }
};

HWY_INLINE void to_array(const Spatial& s, V* values) {
  values[0] = s.turn.x;
  values[1] = s.turn.y;
  values[2] = s.turn.z;
  values[3] = s.push.x;
  values[4] = s.push.y;
  values[5] = s.push.z;
}

/// Cholesky factor of a lower triangle, in place.
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

/// x ← L_b⁻¹ x, where x is 0 before `first`.
HWY_INLINE void solve_base(const BaseFactor& factor, V* x, int first = 0) {
  for (int i = first; i < 6; ++i) {
    for (int k = first; k < i; ++k) x[i] = fnma(factor.lower[triangle(i, k)], x[k], x[i]);
    x[i] = x[i] * factor.inverse[i];
  }
}
/// x ← L_b⁻ᵀ x.
HWY_INLINE void solve_base_transposed(const BaseFactor& factor, V* x) {
  for (int i = 5; i >= 0; --i) {
    for (int k = i + 1; k < 6; ++k) x[i] = fnma(factor.lower[triangle(k, i)], x[k], x[i]);
    x[i] = x[i] * factor.inverse[i];
  }
}

/// L_c and B_c; takes B_c B_cᵀ off the base.
template <int N>
HWY_INLINE ChainFactor factorise_chain(const Pass& pass, std::size_t c, BaseFactor& base) {
  const Chain& chain = pass.model().chains[c];
  const int n = length<N>(chain);
  const ChainFactor factor{pass.scratch(pass.work().factors[c]), n};
  V lower[capacity<N> * (capacity<N> + 1) / 2], inverse[capacity<N>], rows[capacity<N>][6];
  for (int i = 0; i < n * (n + 1) / 2; ++i) lower[i] = load(factor.at + i * width);
  factorise<capacity<N>>(lower, inverse, n);
  for (int j = 0; j < n; ++j) {
    to_array(load_spatial(pass.scratch(pass.work().columns + 6 * (chain.first + j))), rows[j]);
    for (int d = 0; d < 6; ++d) {
      for (int k = 0; k < j; ++k) rows[j][d] = fnma(lower[triangle(j, k)], rows[k][d], rows[j][d]);
      rows[j][d] = rows[j][d] * inverse[j];
      store(rows[j][d], factor.base(j) + d * width);
    }
    for (int d = 0; d < 6; ++d)
      for (int e = 0; e <= d; ++e)
        base.lower[triangle(d, e)] = fnma(rows[j][d], rows[j][e], base.lower[triangle(d, e)]);
  }
  for (int i = 0; i < n * (n + 1) / 2; ++i) store(lower[i], factor.at + i * width);
  for (int j = 0; j < n; ++j) store(inverse[j], factor.inverse(j));
  return factor;
}

/// The joints' part of Lᵀ ν after a step without constraints, as rows `free`. Adds to `reaction` what the
/// joints' torques take from the base.
template <int N>
HWY_INLINE void free_chain(const Pass& pass, const LaneArray& targets_rad, std::size_t c,
                           const ChainFactor& factor, const Base& base, const V* base_motion, V* reaction) {
  const Chain& chain = pass.model().chains[c];
  const int n = length<N>(chain);
  const V h = set(pass.batch.timestep_s);
  V speed[capacity<N>], pushed[capacity<N>];
  for (int j = 0; j < n; ++j) speed[j] = pass.state(pass.batch.rows.speed + chain.first + j);
  for (int j = 0; j < n; ++j) {
    const int index = chain.first + j;
    float* const row = pass.scratch(pass.work().free + index);
    const Spatial column = load_spatial(pass.scratch(pass.work().columns + 6 * index));
    const V torque = drive(pass, targets_rad, pass.link(chain, j), index);
    store(torque, pass.scratch(pass.work().servos + 4 * index + 3));
    V x = h * (torque - (load(row) + dot(column, base.drift)));
    for (int k = 0; k < j; ++k) x = fnma(load(factor.lower(j, k)), pushed[k], x);
    pushed[j] = x * load(factor.inverse(j));
    V sum = pushed[j];
    for (int i = j; i < n; ++i) sum = fma(load(factor.lower(i, j)), speed[i], sum);
    for (int d = 0; d < 6; ++d) {
      const V b = load(factor.base(j) + d * width);
      sum = fma(b, base_motion[d], sum);
      reaction[d] = fma(b, pushed[j], reaction[d]);
    }
    store(sum, row);
  }
}

/// Factorises, and finds the base's part of Lᵀ ν after a step without constraints: what it had, less what the
/// joints take from it, and what a push gives it.
template <int N>
HWY_NOINLINE void free_motion(const Pass& pass, const LaneArray& targets_rad, const Base& base,
                              BaseFactor& factor, V* base_free) {
  const Model& model = pass.model();
  const Symmetric& m = base.inertia;
  const V none = zero(), mass = set(model.mass_kg);
  const V start[21] = {m.xx, m.xy, m.yy, m.xz, m.yz, m.zz, none, none, none, mass, none,
                       none, none, none, mass, none, none, none, none, none, mass};
  for (int i = 0; i < 21; ++i) factor.lower[i] = start[i];
  V motion[6], reaction[6];
  const V3 fallen = set(pass.batch.timestep_s) * (pass.world() * set(model.gravity_m_s2));
  to_array({base.motion.turn, base.motion.push + fallen}, motion);
  for (V& r : reaction) r = none;
  for (std::size_t c = 0; c < model.chains.size(); ++c) {
    const ChainFactor chain = factorise_chain<N>(pass, c, factor);
    free_chain<N>(pass, targets_rad, c, chain, base, motion, reaction);
  }
  factorise<6>(factor.lower, factor.inverse, 6);
  const V3 push = pass.world() * pass.state3(Rows::push);
  V kick[6];
  to_array({cross(pass.state3(Rows::origin) + set(model.torso.com_m), push), push}, kick);
  for (int d = 0; d < 6; ++d) reaction[d] = reaction[d] - kick[d];
  solve_base(factor, reaction);
  for (int d = 0; d < 6; ++d) {
    V sum = hn::Neg(reaction[d]);
    for (int e = d; e < 6; ++e) sum = fma(factor.lower[triangle(e, d)], motion[e], sum);
    base_free[d] = sum;
  }
}

}  // namespace amble::physics::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggled by HWY_TARGET_TOGGLE
