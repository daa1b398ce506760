// Projected successive over-relaxation with a fixed number of sweeps; for each instruction set.
//
// Row by row, with r = target − (cfm/h) p − Wᵀ u its residual,
//   p' = clamp(p + (ω / d) r, low, high),   u += W (p' − p),
// d its diagonal and ω the relaxation factor; ω = 1 is projected Gauss–Seidel (Catto 2009, "Modeling and
// Solving Constraints"). Rows are scaled so that ω / d = 1 (BlockLayout).
#if defined(AMBLE_BATCH_SOLVER_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef AMBLE_BATCH_SOLVER_INL_HPP
#undef AMBLE_BATCH_SOLVER_INL_HPP
#else
#define AMBLE_BATCH_SOLVER_INL_HPP
#endif

#include "amble/core/index.hpp"
#include "amble/physics/batch/contacts-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::physics::batch::HWY_NAMESPACE {

/// Bounds of a block's impulses: joint: low … high; pyramid: a contact, p_n ≥ 0 and |p_t| ≤ μ p_n; sticking:
/// a contact with infinite friction.
enum class Bound { joint, pyramid, sticking };

/// Projection: the change of row r's impulse, which is `before`, that remains of `change` within the bounds.
/// `normal`: the new impulse of the contact's first row. (In lanes without the contact `change` is 0.)
template <Bound bound>
HWY_INLINE V projected(const Block& block, int r, V change, V before, V normal) {
  if constexpr (bound == Bound::joint)
    return max(min(change, block.get(BlockLayout::high, r) - before),
               block.get(BlockLayout::low, r) - before);
  if (r == 0) return max(change, hn::Neg(before));
  if constexpr (bound == Bound::sticking) return change;
  const V limit = block.get(BlockLayout::high, r) * normal;
  return max(min(change, limit - before), hn::Neg(limit) - before);
}

/// Residual of row r at u = 0: target − (cfm/h) p. Friction rows have target 0.
template <Bound bound>
HWY_INLINE V residual_at_rest(const Block& block, int r, V before) {
  const V softness = block.get(BlockLayout::softness, r);
  if (bound != Bound::joint && r > 0) return hn::Neg(softness * before);
  return fnma(softness, before, block.get(BlockLayout::target, r));
}

/// First entry of a row's W that is not 0: column j of L_c⁻¹ is 0 above row j.
template <int n, Bound bound>
constexpr int first_entry(int row) {
  return bound == Bound::joint && n == 3 ? row : 0;
}

/// Impulses and residuals of a block's rows at the present u. The parts of joints and base are summed apart,
/// so that neither sum waits for the other.
template <int n, int rows, Bound bound>
HWY_INLINE void residuals(const Block& block, const V* u_joints, const V* u_base, V* before, V* change) {
  for (int r = 0; r < rows; ++r) {
    const float* const w = block.w(r);
    before[r] = block.get(BlockLayout::impulse, r);
    V joint_part = residual_at_rest<bound>(block, r, before[r]);
    for (int i = first_entry<n, bound>(r); i < n; ++i)
      joint_part = fnma(load(w + i * width), u_joints[i], joint_part);
    V base_part = load(w + n * width) * u_base[0];
    for (int i = 1; i < 5; ++i) base_part = fma(load(w + (n + i) * width), u_base[i], base_part);
    joint_part = fnma(load(w + (n + 5) * width), u_base[5], joint_part);
    change[r] = joint_part - base_part;
  }
}

/// The rows' changes one after the other, each residual first reduced by W_r · W_s times the changes before
/// it (in `change`: first residuals, then changes). Updates `impulse`.
template <int rows, Bound bound>
HWY_INLINE void project(const Block& block, V* impulse, V* change) {
  V normal = zero();
  for (int r = 0; r < rows; ++r) {
    for (int s = 0; s < r; ++s)
      change[r] = fnma(block.get(BlockLayout::gram, r + s - 1), change[s], change[r]);
    change[r] = projected<bound>(block, r, change[r], impulse[r], normal);
    impulse[r] = impulse[r] + change[r];
    if (r == 0) normal = impulse[r];
  }
}

/// u += W Δp, and stores the impulses.
template <int n, int rows, Bound bound>
HWY_INLINE void apply(const Block& block, const V* impulse, const V* change, V* u_joints, V* u_base) {
  for (int r = 0; r < rows; ++r) {
    const float* const w = block.w(r);
    for (int i = first_entry<n, bound>(r); i < n; ++i)
      u_joints[i] = fma(load(w + i * width), change[r], u_joints[i]);
    for (int i = 0; i < 6; ++i) u_base[i] = fma(load(w + (n + i) * width), change[r], u_base[i]);
  }
  for (int r = 0; r < rows; ++r) block.set(BlockLayout::impulse, r, impulse[r]);
}

/// Relaxes a block: over-relaxation row by row, but with all residuals computed before the first update of u
/// and corrected by the Gram matrix. So a row waits for two or three instructions of the row before, not for
/// its whole update.
template <int n, int rows, Bound bound>
HWY_INLINE void relax(const Block& block, V* u_joints, V* u_base) {
  V impulse[rows], change[rows];
  residuals<n, rows, bound>(block, u_joints, u_base, impulse, change);
  project<rows, bound>(block, impulse, change);
  apply<n, rows, bound>(block, impulse, change, u_joints, u_base);
}

/// The same for a chain's three motors and its first contact together.
template <int n, Bound bound>
HWY_INLINE void relax_pair(const Block& motors, const Block& contact, V* u_joints, V* u_base) {
  V impulse[3], change[3], contact_impulse[3], contact_change[3];
  residuals<n, 3, Bound::joint>(motors, u_joints, u_base, impulse, change);
  residuals<n, 3, bound>(contact, u_joints, u_base, contact_impulse, contact_change);
  project<3, Bound::joint>(motors, impulse, change);
  for (int s = 0; s < 3; ++s)
    for (int r = 0; r < 3; ++r)
      contact_change[r] = fnma(contact.get(BlockLayout::cross_gram, 3 * s + r), change[s], contact_change[r]);
  project<3, bound>(contact, contact_impulse, contact_change);
  apply<n, 3, Bound::joint>(motors, impulse, change, u_joints, u_base);
  apply<n, 3, bound>(contact, contact_impulse, contact_change, u_joints, u_base);
}

/// relax() with an update of u after each row.
template <int N, int rows, Bound bound>
HWY_INLINE void relax_alone(const Block& block, V* u_joints, V* u_base) {
  const int n = N >= 0 ? N : block.entries - 6;
  V normal = zero();
  for (int r = 0; r < rows; ++r) {
    const float* const w = block.w(r);
    const V before = block.get(BlockLayout::impulse, r);
    V change = residual_at_rest<bound>(block, r, before);
    for (int i = 0; i < n; ++i) change = fnma(load(w + i * width), u_joints[i], change);
    for (int i = 0; i < 6; ++i) change = fnma(load(w + (n + i) * width), u_base[i], change);
    change = projected<bound>(block, r, change, before, normal);
    const V after = before + change;
    if (r == 0) normal = after;
    block.set(BlockLayout::impulse, r, after);
    for (int i = 0; i < n; ++i) u_joints[i] = fma(load(w + i * width), change, u_joints[i]);
    for (int i = 0; i < 6; ++i) u_base[i] = fma(load(w + (n + i) * width), change, u_base[i]);
  }
}

/// N: length of the chain, or −1.
template <int N, Rows relaxed, int rows, Bound bound>
HWY_INLINE void relax_block(const Block& block, V* u_joints, V* u_base) {
  if constexpr (relaxed == Rows::together) {
    relax<N, rows, bound>(block, u_joints, u_base);
  } else {
    relax_alone<N, rows, bound>(block, u_joints, u_base);
  }
}

/// All blocks of a pass one after the other: those of the torso, then chain by chain. A copy of what
/// block_at() reads, since the compiler has to expect that the store of a vector changes anything in memory.
struct BlockWalk {
  float* next;
  int stride;              ///< floats from one block to the next
  const int* first_joint;  ///< by block of joints: its first row, counted in its chain

  HWY_INLINE Block take(int n) {
    float* const data = next;
    next += stride;
    ++first_joint;
    return {data, n + 6};
  }
};

HWY_INLINE BlockWalk first_block(const Pass& pass) {
  const Workspace& work = pass.work();
  return {pass.scratch(work.blocks), work.block_layout.size() * width, work.block_joint.data()};
}

/// One sweep over the blocks of the torso (N = 0) or of a chain.
template <int N, Rows relaxed, Bound contact>
HWY_INLINE void relax_chain(const ChainBlocks& blocks, int n, BlockWalk& walk, V* u_joints, V* u_base) {
  const int entries = N >= 0 ? N : n;
  if constexpr (N == 3 && relaxed == Rows::together) {
    if (blocks.paired()) {
      const Block motors = walk.take(N), first_contact = walk.take(N);
      relax_pair<N, contact>(motors, first_contact, u_joints, u_base);
      for (int b = 2; b < blocks.count; ++b) relax<N, 3, contact>(walk.take(N), u_joints, u_base);
      return;
    }
  }
  for (int b = 0; b < blocks.joint_blocks; ++b) {
    const int left = blocks.joint_rows - *walk.first_joint;
    const Block block = walk.take(entries);
    if (relaxed == Rows::together || left >= 3) {
      relax_block<N, relaxed, 3, Bound::joint>(block, u_joints, u_base);
    } else if (left == 2) {
      relax_block<N, relaxed, 2, Bound::joint>(block, u_joints, u_base);
    } else {
      relax_block<N, relaxed, 1, Bound::joint>(block, u_joints, u_base);
    }
  }
  for (int b = blocks.joint_blocks; b < blocks.count; ++b)
    relax_block<N, relaxed, 3, contact>(walk.take(entries), u_joints, u_base);
}

/// All sweeps: u (u_joints in the scratch memory and u_base) after the constraints.
template <int N, Rows relaxed, Bound contact>
HWY_NOINLINE void solve(const Pass pass, V* u_base_out) {
  const Chain* const chains = pass.model().chains.data();
  const ChainBlocks* const blocks = pass.work().chain_blocks.data();
  const std::size_t chain_count = pass.model().chains.size();
  float* const all_u_joints = pass.scratch(pass.work().u_joints);
  V u_base[6];
  for (int d = 0; d < 6; ++d) u_base[d] = u_base_out[d];
  for (int sweeps = pass.model().iterations; sweeps > 0; --sweeps) {
    BlockWalk walk = first_block(pass);
    V none[1];
    relax_chain<0, Rows::together, contact>(blocks[0], 0, walk, none, u_base);
    for (std::size_t c = 0; c < chain_count; ++c) {
      const int n = length<N>(chains[c]);
      float* const u_chain = all_u_joints + chains[c].first * width;
      V u_joints[capacity<N>];
      for (int j = 0; j < n; ++j) u_joints[j] = load(u_chain + j * width);
      relax_chain<N, relaxed, contact>(blocks[c + 1], n, walk, u_joints, u_base);
      for (int j = 0; j < n; ++j) store(u_joints[j], u_chain + j * width);
    }
  }
  for (int d = 0; d < 6; ++d) u_base_out[d] = u_base[d];
}

}  // namespace amble::physics::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggled by HWY_TARGET_TOGGLE
