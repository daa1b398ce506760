// Projected successive over-relaxation with a fixed number of iterations, for each instruction set.
#if defined(AMBLE_BATCH_SOLVER_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef AMBLE_BATCH_SOLVER_INL_HPP
#undef AMBLE_BATCH_SOLVER_INL_HPP
#else
#define AMBLE_BATCH_SOLVER_INL_HPP
#endif

#include "amble/core/index.hpp"
#include "amble/physics/batch/constraints-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::physics::batch::HWY_NAMESPACE {

enum class Bound { joint, cone, stuck };  ///< stuck: contact with infinite friction

/// How far the impulse of row r, `before` now, moves when it is asked to move by `change`. `normal`: the
/// impulse of the contact's first row. Lanes without the contact have W = 0 and ask for nothing.
template <Bound bound>
HWY_INLINE V bounded(const Block& block, int r, V change, V before, V normal) {
  if constexpr (bound == Bound::joint)
    return hn::Max(hn::Min(change, block.get(BlockShape::high, r) - before),
                   block.get(BlockShape::low, r) - before);
  if (r == 0) return hn::Max(change, hn::Neg(before));
  if constexpr (bound == Bound::stuck) return change;
  const V most = block.get(BlockShape::high, r) * normal;
  return hn::Max(hn::Min(change, most - before), hn::Neg(most) - before);
}

/// The change that row r asks for where the state is 0.
template <Bound bound>
HWY_INLINE V wanted_change(const Block& block, int r, V before) {
  const V softness = block.get(BlockShape::softness, r);
  if (bound != Bound::joint && r > 0) return hn::Neg(softness * before);
  return fnma(softness, before, block.get(BlockShape::bias, r));
}

/// First number of a row's W that is not 0: a joint's own row has no part in joints nearer to the torso.
template <int n, Bound bound>
constexpr int first_number(int row) {
  return bound == Bound::joint && n == 3 ? row : 0;
}

/// Before each row moves: its impulse, and the change that it asks for as things stand.
template <int n, int rows, Bound bound>
HWY_INLINE void measure(const Block& block, const V* joints, const V* base, V* before, V* change) {
  for (int r = 0; r < rows; ++r) {
    const float* const w = block.w(r);
    before[r] = block.get(BlockShape::impulse, r);
    V near = wanted_change<bound>(block, r, before[r]);
    for (int i = first_number<n, bound>(r); i < n; ++i) near = fnma(load(w + i * width), joints[i], near);
    V far = load(w + n * width) * base[0];
    for (int i = 1; i < 5; ++i) far = fma(load(w + (n + i) * width), base[i], far);
    near = fnma(load(w + (n + 5) * width), base[5], near);
    change[r] = near - far;
  }
}

/// The changes that the rows get, one after the other; `impulse` becomes what follows.
template <int rows, Bound bound>
HWY_INLINE void settle(const Block& block, V* impulse, V* change) {
  V normal = zero();
  for (int r = 0; r < rows; ++r) {
    for (int s = 0; s < r; ++s)
      change[r] = fnma(block.get(BlockShape::gram, r + s - 1), change[s], change[r]);
    change[r] = bounded<bound>(block, r, change[r], impulse[r], normal);
    impulse[r] = impulse[r] + change[r];
    if (r == 0) normal = impulse[r];
  }
}

template <int n, int rows, Bound bound>
HWY_INLINE void push(const Block& block, const V* impulse, const V* change, V* joints, V* base) {
  for (int r = 0; r < rows; ++r) {
    const float* const w = block.w(r);
    for (int i = first_number<n, bound>(r); i < n; ++i)
      joints[i] = fma(load(w + i * width), change[r], joints[i]);
    for (int i = 0; i < 6; ++i) base[i] = fma(load(w + (n + i) * width), change[r], base[i]);
  }
  for (int r = 0; r < rows; ++r) block.set(BlockShape::impulse, r, impulse[r]);
}

/// One visit to a block: exactly over-relaxation row by row, but all rows are measured before the first of
/// them pushes, and their influence on each other is made good with the products of their W: so a row waits
/// for two or three instructions of the row before, not for its whole update.
template <int n, int rows, Bound bound>
HWY_INLINE void visit(const Block& block, V* joints, V* base) {
  V impulse[rows], change[rows];
  measure<n, rows, bound>(block, joints, base, impulse, change);
  settle<rows, bound>(block, impulse, change);
  push<n, rows, bound>(block, impulse, change, joints, base);
}

/// The same for a chain's three motors and its first contact together.
template <int n, Bound bound>
HWY_INLINE void visit_pair(const Block& motors, const Block& contact, V* joints, V* base) {
  V impulse[3], change[3], touch_impulse[3], touch_change[3];
  measure<n, 3, Bound::joint>(motors, joints, base, impulse, change);
  measure<n, 3, bound>(contact, joints, base, touch_impulse, touch_change);
  settle<3, Bound::joint>(motors, impulse, change);
  for (int s = 0; s < 3; ++s)
    for (int r = 0; r < 3; ++r)
      touch_change[r] = fnma(contact.get(BlockShape::cross, 3 * s + r), change[s], touch_change[r]);
  settle<3, bound>(contact, touch_impulse, touch_change);
  push<n, 3, Bound::joint>(motors, impulse, change, joints, base);
  push<n, 3, bound>(contact, touch_impulse, touch_change, joints, base);
}

/// visit() for chains of any length.
template <int rows, Bound bound>
HWY_INLINE void visit_any(const Block& block, V* joints, V* base) {
  const int n = block.numbers - 6;
  V normal = zero();
  for (int r = 0; r < rows; ++r) {
    const float* const w = block.w(r);
    const V before = block.get(BlockShape::impulse, r);
    V change = wanted_change<bound>(block, r, before);
    for (int i = 0; i < n; ++i) change = fnma(load(w + i * width), joints[i], change);
    for (int i = 0; i < 6; ++i) change = fnma(load(w + (n + i) * width), base[i], change);
    change = bounded<bound>(block, r, change, before, normal);
    const V after = before + change;
    if (r == 0) normal = after;
    block.set(BlockShape::impulse, r, after);
    for (int i = 0; i < n; ++i) joints[i] = fma(load(w + i * width), change, joints[i]);
    for (int i = 0; i < 6; ++i) base[i] = fma(load(w + (n + i) * width), change, base[i]);
  }
}

template <int N, int rows, Bound bound>
HWY_INLINE void visit_block(const Block& block, V* joints, V* base) {
  if constexpr (N >= 0) {
    visit<N, rows, bound>(block, joints, base);
  } else {
    visit_any<rows, bound>(block, joints, base);
  }
}

/// Once through all blocks of the torso (N = 0) or of a chain.
template <int N, Bound contact>
HWY_INLINE void visit_chain(const Pass& pass, const ChainBlocks& blocks, int n, V* joints, V* base) {
  if constexpr (N == 3) {
    if (blocks.paired()) {
      visit_pair<N, contact>(block_at(pass, blocks.first, N), block_at(pass, blocks.first + 1, N), joints,
                             base);
      for (int b = 2; b < blocks.count; ++b)
        visit<N, 3, contact>(block_at(pass, blocks.first + b, N), joints, base);
      return;
    }
  }
  for (int b = 0; b < blocks.joint_blocks; ++b) {
    const Block block = block_at(pass, blocks.first + b, N >= 0 ? N : n);
    const int left = n - pass.work().block_joint[to_index(blocks.first + b)];
    if (N == 3 || left >= 3) {
      visit_block<N, 3, Bound::joint>(block, joints, base);
    } else if (left == 2) {
      visit_block<N, 2, Bound::joint>(block, joints, base);
    } else {
      visit_block<N, 1, Bound::joint>(block, joints, base);
    }
  }
  for (int b = blocks.joint_blocks; b < blocks.count; ++b)
    visit_block<N, 3, contact>(block_at(pass, blocks.first + b, N >= 0 ? N : n), joints, base);
}

/// Brings Lᵀ ν (rows `free` and `base`) to what all constraints leave of it.
template <int N, Bound contact>
HWY_NOINLINE void solve(const Pass& pass, V* base_out) {
  const Model& model = pass.model();
  V base[6];
  for (int d = 0; d < 6; ++d) base[d] = base_out[d];
  for (int iteration = 0; iteration < model.iterations; ++iteration) {
    V none[1];
    visit_chain<0, contact>(pass, pass.work().chain_blocks[0], 0, none, base);
    for (std::size_t c = 0; c < model.chains.size(); ++c) {
      const Chain& chain = model.chains[c];
      const int n = length<N>(chain);
      float* const free = pass.scratch(pass.work().free + chain.first);
      V joints[capacity<N>];
      for (int j = 0; j < n; ++j) joints[j] = load(free + j * width);
      visit_chain<N, contact>(pass, pass.work().chain_blocks[c + 1], n, joints, base);
      for (int j = 0; j < n; ++j) store(joints[j], free + j * width);
    }
  }
  for (int d = 0; d < 6; ++d) base_out[d] = base[d];
}

}  // namespace amble::physics::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggled by HWY_TARGET_TOGGLE
