// Projected Gauss–Seidel with a fixed number of iterations, for each instruction set.
#if defined(AMBLE_BATCH_SOLVER_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef AMBLE_BATCH_SOLVER_INL_HPP
#undef AMBLE_BATCH_SOLVER_INL_HPP
#else
#define AMBLE_BATCH_SOLVER_INL_HPP
#endif

#include "amble/physics/batch/constraints-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::physics::batch::HWY_NAMESPACE {

enum class Bound { joint, cone, stuck };  ///< stuck: contact with infinite friction

/// Impulse of row r within its bounds; `normal` is the impulse of the contact's first row.
template <Bound bound>
HWY_INLINE V bounded(const Block& block, int r, V impulse, V normal) {
  const V high = block.get(BlockShape::high, r);
  if constexpr (bound == Bound::joint) return hn::Max(hn::Min(impulse, high), block.get(BlockShape::low, r));
  if (r == 0) return hn::Min(hn::Max(impulse, zero()), high);
  const V most = bound == Bound::cone ? high * normal : high;
  return hn::Max(hn::Min(impulse, most), hn::Neg(most));
}

/// One visit to a block: exactly Gauss–Seidel row by row, but all rows are measured before the first of them
/// pushes, and their influence on each other is made good with the products of their W: so a row waits for
/// two or three instructions of the row before, not for its whole update.
template <int n, int rows, Bound bound>
HWY_INLINE void visit(const Block& block, V* joints, V* base) {
  V before[rows], after[rows], asked[rows];
  for (int r = 0; r < rows; ++r) before[r] = block.get(BlockShape::impulse, r);
  for (int r = 0; r < rows; ++r) {
    const float* const w = block.w(r);
    V near = fma(block.get(BlockShape::gain, r), before[r], block.get(BlockShape::bias, r));
    for (int i = 0; i < n; ++i) near = fnma(load(w + i * width), joints[i], near);
    V far = load(w + n * width) * base[0];
    for (int i = 1; i < 3; ++i) far = fma(load(w + (n + i) * width), base[i], far);
    for (int i = 3; i < 6; ++i) near = fnma(load(w + (n + i) * width), base[i], near);
    asked[r] = near - far;
    for (int s = 0; s < r; ++s) asked[r] = fma(block.get(BlockShape::gram, r + s - 1), before[s], asked[r]);
  }
  for (int r = 0; r < rows; ++r) {
    for (int s = 0; s < r; ++s) asked[r] = fnma(block.get(BlockShape::gram, r + s - 1), after[s], asked[r]);
    after[r] = bounded<bound>(block, r, asked[r], after[0]);
    block.set(BlockShape::impulse, r, after[r]);
  }
  for (int r = 0; r < rows; ++r) {
    const V change = after[r] - before[r];
    const float* const w = block.w(r);
    for (int i = 0; i < n; ++i) joints[i] = fma(load(w + i * width), change, joints[i]);
    for (int i = 0; i < 6; ++i) base[i] = fma(load(w + (n + i) * width), change, base[i]);
  }
}

/// visit() for chains of any length.
template <int rows, Bound bound>
HWY_INLINE void visit_any(const Block& block, V* joints, V* base) {
  const int n = block.numbers - 6;
  V normal = zero();
  for (int r = 0; r < rows; ++r) {
    const float* const w = block.w(r);
    const V before = block.get(BlockShape::impulse, r);
    V asked = fma(block.get(BlockShape::gain, r), before, block.get(BlockShape::bias, r));
    for (int i = 0; i < n; ++i) asked = fnma(load(w + i * width), joints[i], asked);
    for (int i = 0; i < 6; ++i) asked = fnma(load(w + (n + i) * width), base[i], asked);
    const V after = bounded<bound>(block, r, asked, normal);
    if (r == 0) normal = after;
    block.set(BlockShape::impulse, r, after);
    const V change = after - before;
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
  for (int b = 0; b < blocks.joint_blocks; ++b) {
    const Block block = block_at(pass, blocks.first + b, N >= 0 ? N : n);
    const int left = n - pass.work().block_point[static_cast<std::size_t>(blocks.first + b)];
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
  for (int iteration = 0; iteration < pass.batch.iterations; ++iteration) {
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
