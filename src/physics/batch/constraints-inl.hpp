// Constraint rows in blocks, and the blocks of joints; for each instruction set.
//
// Each row is J ν⁺ + softness p = target (softness cfm/h but for torque servos) with bounds of its impulse p:
// ODE's soft constraints (manual, "Constraint Force Mixing (CFM)"; docs/BATCH.md, "Constraint rows"). Of J
// the solver needs W = L⁻¹ Jᵀ: by forward substitution the chain's part is W_c = L_c⁻¹ J_cᵀ, the base's W_b =
// L_b⁻¹ (J_bᵀ − B_c W_c).
#if defined(AMBLE_BATCH_CONSTRAINTS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef AMBLE_BATCH_CONSTRAINTS_INL_HPP
#undef AMBLE_BATCH_CONSTRAINTS_INL_HPP
#else
#define AMBLE_BATCH_CONSTRAINTS_INL_HPP
#endif

#include "amble/core/index.hpp"
#include "amble/physics/batch/factor-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::physics::batch::HWY_NAMESPACE {

/// View of one block (BlockLayout).
struct Block {
  float* data;
  int entries;  ///< of a W: those of the chain, then 6

  float* w(int row) const { return data + row * entries * width; }
  V get(int field, int row = 0) const { return load(data + (3 * entries + field + row) * width); }
  void set(int field, int row, V v) const { store(v, data + (3 * entries + field + row) * width); }
};

HWY_INLINE Block block_at(const Pass& pass, int index, int n) {
  const int size = pass.work().block_layout.size();
  return {pass.scratch(pass.work().blocks + index * size), n + 6};
}

/// How the rows of chains are relaxed. `together`: block by block, the three motors of a chain with its first
/// contact; only for chains of three joints without friction. `alone`: row by row.
enum class Rows { together, alone };

/// The rows of a block while it is built, column by column: a column, one entry of the W of each row, is
/// written as soon as it is known, so that few vectors are waiting for a register.
template <int N, int rows>
struct ConstraintRows {
  explicit ConstraintRows(const Block& of) : block(of) {}

  Block block;
  /// The chain's columns before they are scaled (and, on uneven ground, turned): those of the base need them.
  V w_chain[capacity<N> > 0 ? capacity<N> : 1][rows];
  V sum[rows];  ///< Wᵀ W + softness, of the columns so far
  V target[rows];
  V softness[rows];  ///< velocity per impulse
  V inverse_scale[rows];
  Mask enabled[rows];

  /// To be called before the first column.
  HWY_INLINE void begin() {
    for (int r = 0; r < rows; ++r) sum[r] = softness[r];
  }

  /// Writes a column of W. Columns are put in their order.
  HWY_INLINE void put(int column, const V* w) {
    for (int r = 0; r < rows; ++r) {
      store(w[r], block.w(r) + column * width);
      sum[r] = fma(w[r], w[r], sum[r]);
    }
  }

  /// Finds each row's scale, s = √((Wᵀ W + softness) / ω), and writes all fields but bounds, impulses and
  /// Gram matrix. Lanes without the row get W = 0 and target 0: there it has no effect.
  HWY_INLINE void find_scales(float relaxation) {
    const V inverse_relaxation = set(1.0f / relaxation);
    for (int r = 0; r < rows; ++r) {
      const V scale = hn::Sqrt(sum[r] * inverse_relaxation);
      inverse_scale[r] = hn::IfThenElseZero(enabled[r], set(1.0f) / scale);
      block.set(BlockLayout::softness, r, softness[r] * inverse_scale[r] * inverse_scale[r]);
      block.set(BlockLayout::target, r, target[r] * inverse_scale[r]);
      block.set(BlockLayout::scale, r, scale);
      block.set(BlockLayout::inverse_scale, r, inverse_scale[r]);
    }
  }

  /// Scales W; writes its Gram matrix, W_r · W_s: what a unit impulse of one row does to the velocity of
  /// another; and applies the impulses with which the block starts: u += W p (warm starting; Catto 2009).
  HWY_INLINE void scale_and_start(V* u_joints, V* u_base) const {
    const int n = block.entries - 6;
    V impulse[rows], gram[3] = {zero(), zero(), zero()};
    for (int r = 0; r < rows; ++r) impulse[r] = block.get(BlockLayout::impulse, r);
    for (int i = 0; i < block.entries; ++i) {
      V w[rows];
      V& u = i < n ? u_joints[i] : u_base[i - n];
      for (int r = 0; r < rows; ++r) {
        w[r] = load(block.w(r) + i * width) * inverse_scale[r];
        store(w[r], block.w(r) + i * width);
        for (int s = 0; s < r; ++s) gram[r + s - 1] = fma(w[r], w[s], gram[r + s - 1]);
        u = fma(w[r], impulse[r], u);
      }
    }
    for (int pair = 0; pair < rows * (rows - 1) / 2; ++pair) block.set(BlockLayout::gram, pair, gram[pair]);
  }
};

/// The columns of the joint rows from `first` on. J is the unit vector of the joint, so W_c is a column of
/// L_c⁻¹ and J_b = 0.
template <int N, Rows relaxed, int rows>
HWY_INLINE void put_joint_columns(const Pass& pass, const Chain& chain, const ChainFactor& factor, int first,
                                  ConstraintRows<N, rows>& row_set) {
  int joint[rows];
  for (int r = 0; r < rows; ++r)
    joint[r] = relaxed == Rows::together ? first + r : pass.row_of(chain, first + r).link;
  for (int i = 0; i < factor.n; ++i) {
    V* const w = row_set.w_chain[i];
    for (int r = 0; r < rows; ++r) {
      w[r] = i == joint[r] ? load(factor.inverse(i)) : zero();
      if (i <= joint[r]) continue;
      for (int k = joint[r]; k < i; ++k) w[r] = fnma(load(factor.lower(i, k)), row_set.w_chain[k][r], w[r]);
      w[r] = w[r] * load(factor.inverse(i));
    }
    row_set.put(i, w);
  }
  for (int d = 0; d < 6; ++d) {
    V w[rows];
    for (int r = 0; r < rows; ++r) {
      w[r] = zero();
      for (int j = joint[r]; j < factor.n; ++j)
        w[r] = fnma(load(factor.base(j) + d * width), row_set.w_chain[j][r], w[r]);
    }
    row_set.put(factor.n + d, w);
  }
}

/// Builds a block of up to three joint rows of a chain, from row `first` on; false if no lane has such a row.
template <int N, Rows relaxed, int rows>
HWY_INLINE bool joint_block(const Pass& pass, const Chain& chain, const ChainFactor& factor, int first,
                            const Block& block, V* u_joints, V* u_base) {
  Mask enabled = no_lanes();
  ConstraintRows<N, rows> row_set(block);
  for (int r = 0; r < rows; ++r) {
    const float* const joint_row = pass.joint_row(chain, first + r);
    row_set.enabled[r] = load(joint_row + width) < load(joint_row + 2 * width);
    row_set.target[r] = load(joint_row);
    row_set.softness[r] = load(joint_row + 4 * width);
    enabled = hn::Or(enabled, row_set.enabled[r]);
  }
  if (hn::AllFalse(Floats(), hn::And(enabled, pass.active()))) return false;
  row_set.begin();
  put_joint_columns<N, relaxed>(pass, chain, factor, first, row_set);
  row_set.find_scales(pass.model().joint_relaxation);
  for (int r = 0; r < rows; ++r) {
    const float* const joint_row = pass.joint_row(chain, first + r);
    // Bounds times s; an infinite one stays infinite, and 0 × s is 0.
    const V scale = block.get(BlockLayout::scale, r);
    const V low = load(joint_row + width) * scale, high = load(joint_row + 2 * width) * scale;
    block.set(BlockLayout::low, r, low);
    block.set(BlockLayout::high, r, high);
    const V before = pass.state(pass.rows().joint_impulse + chain.first_row + first + r) * scale;
    block.set(BlockLayout::impulse, r, max(min(before, high), low));
  }
  row_set.scale_and_start(u_joints, u_base);
  return true;
}

/// Blocks of a chain's joint rows, three rows each.
template <int N, Rows relaxed>
HWY_INLINE void joint_blocks(const Pass& pass, const Chain& chain, const ChainFactor& factor,
                             ChainBlocks& blocks, V* u_joints, V* u_base) {
  const int n = length<N>(chain), row_count = relaxed == Rows::together ? N : chain.row_count;
  blocks.joint_rows = row_count;
  for (int first = 0; first < row_count; first += 3) {
    const Block block = block_at(pass, blocks.first + blocks.count, n);
    const int rows = row_count - first < 3 ? row_count - first : 3;
    bool any = false;
    if (rows == 3) any = joint_block<N, relaxed, 3>(pass, chain, factor, first, block, u_joints, u_base);
    if (rows == 2) any = joint_block<N, relaxed, 2>(pass, chain, factor, first, block, u_joints, u_base);
    if (rows == 1) any = joint_block<N, relaxed, 1>(pass, chain, factor, first, block, u_joints, u_base);
    if (!any) {
      for (int r = first; r < first + rows; ++r)
        pass.set_state(pass.rows().joint_impulse + chain.first_row + r, zero());
      continue;
    }
    pass.work().block_joint[to_index(blocks.first + blocks.count)] = first;
    ++blocks.joint_blocks;
    ++blocks.count;
  }
}

}  // namespace amble::physics::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggled by HWY_TARGET_TOGGLE
