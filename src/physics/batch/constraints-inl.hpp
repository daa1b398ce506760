// Blocks of constraint rows: motors and stops, contacts; for each instruction set.
#if defined(AMBLE_BATCH_CONSTRAINTS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef AMBLE_BATCH_CONSTRAINTS_INL_HPP
#undef AMBLE_BATCH_CONSTRAINTS_INL_HPP
#else
#define AMBLE_BATCH_CONSTRAINTS_INL_HPP
#endif

#include <cmath>
#include <limits>

#include "amble/physics/batch/factor-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::physics::batch::HWY_NAMESPACE {

/// One block while it is made and solved.
struct Block {
  float* at;
  int numbers;  ///< of a W: of the chain, then 6

  float* w(int row) const { return at + row * numbers * width; }
  V get(int field, int row = 0) const { return load(at + (3 * numbers + field + row) * width); }
  void set(int field, int row, V v) const { store(v, at + (3 * numbers + field + row) * width); }
};

HWY_INLINE Block block_at(const Pass& pass, int index, int n) {
  const int size = pass.work().shape.size();
  return {pass.scratch(pass.work().blocks + index * size), n + 6};
}

/// Scales a row to unit diagonal. `softness`: cfm per timestep.
HWY_INLINE void finish_row(const Block& block, int row, const V* w, V wanted, V softness) {
  V sum = softness;
  for (int i = 0; i < block.numbers; ++i) sum = fma(w[i], w[i], sum);
  const V root = hn::Sqrt(sum), inverse = set(1.0f) / root;
  for (int i = 0; i < block.numbers; ++i) store(w[i] * inverse, block.w(row) + i * width);
  block.set(BlockShape::gain, row, fnma(softness * inverse, inverse, set(1.0f)));
  block.set(BlockShape::bias, row, wanted * inverse);
  block.set(BlockShape::root, row, root);
  block.set(BlockShape::inverse, row, inverse);
}

/// Products of the rows with each other, and Lᵀ ν moved by the impulses that the block starts with.
template <int rows>
HWY_INLINE void finish_block(const Block& block, V* joints, V* base) {
  const int n = block.numbers - 6;
  V gram[3] = {zero(), zero(), zero()};
  V impulse[rows];
  for (int r = 0; r < rows; ++r) impulse[r] = block.get(BlockShape::impulse, r);
  for (int i = 0; i < block.numbers; ++i) {
    V w[rows];
    V& number = i < n ? joints[i] : base[i - n];
    for (int r = 0; r < rows; ++r) {
      w[r] = load(block.w(r) + i * width);
      number = fma(w[r], impulse[r], number);
      for (int s = 0; s < r; ++s) gram[r + s - 1] = fma(w[r], w[s], gram[r + s - 1]);
    }
  }
  for (int g = 0; g < 3; ++g) block.set(BlockShape::gram, g, gram[g]);
}

/// What is left of a unit force's W for the base, once the chain's part is known: L_b⁻¹ (J − B W).
HWY_INLINE void finish_base(const ChainFactor& chain, const BaseFactor& factor, V* w) {
  for (int j = 0; j < chain.n; ++j)
    for (int d = 0; d < 6; ++d) w[chain.n + d] = fnma(load(chain.base(j) + d * width), w[j], w[chain.n + d]);
  solve_base(factor, w + chain.n);
}

/// Motors and stops of up to three joints of a chain, from `first` on; false if no lane has one.
template <int N, int rows>
HWY_INLINE bool joint_block(const Pass& pass, const Chain& chain, const ChainFactor& factor,
                            const BaseFactor& base, int first, const Block& block, V* joints, V* base_free) {
  const int n = length<N>(chain);
  const V softness = set(pass.model().cfm_s_per_kg / pass.batch.timestep_s);
  Mask needed = nowhere();
  for (int r = 0; r < rows; ++r) {
    const float* const servo = pass.scratch(pass.work().servos + 4 * (chain.first + first + r));
    needed = hn::Or(needed, load(servo + width) < load(servo + 2 * width));
  }
  if (hn::AllFalse(Floats(), hn::And(needed, pass.active()))) return false;
  for (int r = 0; r < rows; ++r) {
    const int j = first + r;
    V w[capacity<N> + 6];
    for (int i = 0; i < n + 6; ++i) w[i] = zero();
    w[j] = load(factor.inverse(j));
    for (int i = j + 1; i < n; ++i) {
      for (int k = j; k < i; ++k) w[i] = fnma(load(factor.lower(i, k)), w[k], w[i]);
      w[i] = w[i] * load(factor.inverse(i));
    }
    finish_base(factor, base, w);
    const float* const servo = pass.scratch(pass.work().servos + 4 * (chain.first + j));
    finish_row(block, r, w, load(servo), softness);
    // An infinite bound stays so; 0 × root is 0.
    const V root = block.get(BlockShape::root, r);
    const V low = load(servo + width) * root, high = load(servo + 2 * width) * root;
    block.set(BlockShape::low, r, low);
    block.set(BlockShape::high, r, high);
    const V before = pass.state(pass.batch.rows.joint_impulse + chain.first + j) * root;
    block.set(BlockShape::impulse, r, hn::Max(hn::Min(before, high), low));
  }
  finish_block<rows>(block, joints, base_free);
  return true;
}

/// The direction in which a contact's row pushes: up first, then as ODE's two friction directions.
HWY_INLINE V3 direction(const Columns& world, int row) {
  return row == 0 ? world.z : row == 1 ? world.y : world.x;
}

/// Bounds of the impulses, and those of the step before within them.
HWY_INLINE void bound_contact(const Pass& pass, int p, Mask touches, const Block& block) {
  const float friction = pass.model().friction;
  const V open = hn::IfThenElseZero(touches, set(std::numeric_limits<float>::infinity()));
  const int row = pass.batch.rows.point_impulse + 3 * p;
  const V normal = hn::Min(hn::Max(pass.state(row) * block.get(BlockShape::root), zero()), open);
  block.set(BlockShape::high, 0, open);
  block.set(BlockShape::impulse, 0, normal);
  for (int r = 1; r < 3; ++r) {
    const V before = pass.state(row + r) * block.get(BlockShape::root, r);
    V high = open, most = open;
    if (!std::isinf(friction)) {
      high = set(friction) * block.get(BlockShape::root, r) * block.get(BlockShape::inverse);
      most = high * normal;
    }
    block.set(BlockShape::high, r, high);
    block.set(BlockShape::impulse, r, hn::Max(hn::Min(before, most), hn::Neg(most)));
  }
}

/// Contact of a point with the ground: as deep as `depth` in the lanes that touch.
template <int N>
HWY_INLINE void contact_block(const Pass& pass, int p, const Chain* chain, const ChainFactor& factor,
                              const BaseFactor& base, const Block& block, V* joints, V* base_free) {
  const Point& point = pass.model().points[static_cast<std::size_t>(p)];
  const Columns world = pass.world();
  V3 at = pass.state3(Rows::origin) + set(point.position_m);
  if (N != 0) {
    const int row = pass.pose_row(chain->first + point.link);
    const Columns axes{pass.state3(row), pass.state3(row + 3), pass.state3(row + 6)};
    at = pass.state3(row + 9) + axes * set(point.position_m);
  }
  at = fnma(set(point.radius_m), world.z, at);
  const V height = load(pass.scratch(pass.work().heights + p));
  const Mask touches = hn::And(height <= zero(), pass.active());
  const V softness = set(pass.model().cfm_s_per_kg / pass.batch.timestep_s);
  for (int r = 0; r < 3; ++r) {
    const V3 along = direction(world, r);
    const Spatial push{cross(at, along), along};
    const int n = factor.n;
    V w[capacity<N> + 6];
    for (int j = 0; j < n; ++j) {
      w[j] = zero();
      if (j > point.link) continue;
      w[j] = dot(joint_motion(pass, *chain, j), push);
    }
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < j; ++k) w[j] = fnma(load(factor.lower(j, k)), w[k], w[j]);
      w[j] = w[j] * load(factor.inverse(j));
    }
    to_array(push, w + n);
    finish_base(factor, base, w);
    const V wanted = r == 0 ? set(-pass.model().erp / pass.batch.timestep_s) * height : zero();
    finish_row(block, r, w, wanted, softness);
  }
  block.set(BlockShape::position, 0, at.x);
  block.set(BlockShape::position, 1, at.y);
  block.set(BlockShape::position, 2, at.z);
  bound_contact(pass, p, touches, block);
  finish_block<3>(block, joints, base_free);
}

/// Blocks of all contacts of the torso (segment 0, N = 0) or of a chain, behind those already there.
template <int N>
HWY_INLINE void contact_blocks(const Pass& pass, int segment, const Chain* chain, const ChainFactor& factor,
                               const BaseFactor& base, ChainBlocks& blocks, V* joints, V* base_free) {
  const Model& model = pass.model();
  const Mask active = pass.active();
  unsigned char* const felt =
      pass.work().felt.data() + static_cast<std::size_t>(pass.lane / width) * model.points.size();
  for (int g = model.first_geom[static_cast<std::size_t>(segment)];
       g < model.first_geom[static_cast<std::size_t>(segment) + 1]; ++g) {
    const PointGroup& geom = model.geoms[static_cast<std::size_t>(g)];
    for (int p = geom.first; p < geom.first + geom.count; ++p) {
      const V height = load(pass.scratch(pass.work().heights + p));
      if (hn::AllFalse(Floats(), hn::And(height <= zero(), active))) {
        if (felt[p]) store3(zero3(), pass.row(pass.batch.rows.point_impulse + 3 * p), pass.lane);
        felt[p] = 0;
        continue;
      }
      felt[p] = 1;
      const int index = blocks.first + blocks.count++;
      pass.work().block_point[static_cast<std::size_t>(index)] = p;
      contact_block<N>(pass, p, chain, factor, base, block_at(pass, index, factor.n), joints, base_free);
    }
  }
}

/// All blocks of a chain; its Lᵀ ν moves by the impulses they start with.
template <int N>
HWY_INLINE void chain_blocks(const Pass& pass, std::size_t c, const BaseFactor& base, int first_block,
                             V* base_free) {
  const Chain& chain = pass.model().chains[c];
  const int n = length<N>(chain);
  const ChainFactor factor{pass.scratch(pass.work().factors[c]), n};
  ChainBlocks& blocks = pass.work().chain_blocks[c + 1];
  blocks = {first_block, 0, 0};
  float* const free = pass.scratch(pass.work().free + chain.first);
  V joints[capacity<N>];
  for (int j = 0; j < n; ++j) joints[j] = load(free + j * width);
  for (int j = 0; j < n; j += 3) {
    const Block block = block_at(pass, blocks.first + blocks.count, n);
    const int rows = n - j < 3 ? n - j : 3;
    bool any = false;
    if (rows == 3) any = joint_block<N, 3>(pass, chain, factor, base, j, block, joints, base_free);
    if (rows == 2) any = joint_block<N, 2>(pass, chain, factor, base, j, block, joints, base_free);
    if (rows == 1) any = joint_block<N, 1>(pass, chain, factor, base, j, block, joints, base_free);
    if (!any) {
      for (int r = j; r < j + rows; ++r)
        pass.set_state(pass.batch.rows.joint_impulse + chain.first + r, zero());
      continue;
    }
    pass.work().block_point[static_cast<std::size_t>(blocks.first + blocks.count)] = j;
    ++blocks.joint_blocks;
    ++blocks.count;
  }
  contact_blocks<N>(pass, static_cast<int>(c) + 1, &chain, factor, base, blocks, joints, base_free);
  for (int j = 0; j < n; ++j) store(joints[j], free + j * width);
}

template <int N>
HWY_NOINLINE void all_blocks(const Pass& pass, const BaseFactor& base, V* base_free) {
  ChainBlocks& torso = pass.work().chain_blocks[0];
  torso = {0, 0, 0};
  V none[1];
  contact_blocks<0>(pass, 0, nullptr, {nullptr, 0}, base, torso, none, base_free);
  int first = torso.count;
  for (std::size_t c = 0; c < pass.model().chains.size(); ++c) {
    chain_blocks<N>(pass, c, base, first, base_free);
    first += pass.work().chain_blocks[c + 1].count;
  }
}

}  // namespace amble::physics::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggled by HWY_TARGET_TOGGLE
