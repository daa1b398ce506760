// Blocks of constraint rows: motors and stops, contacts; for each instruction set.
#if defined(AMBLE_BATCH_CONSTRAINTS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef AMBLE_BATCH_CONSTRAINTS_INL_HPP
#undef AMBLE_BATCH_CONSTRAINTS_INL_HPP
#else
#define AMBLE_BATCH_CONSTRAINTS_INL_HPP
#endif

#include <cmath>
#include <limits>

#include "amble/core/index.hpp"
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

/// What unit forces and torques along the world's axes do to the base alone, L_b⁻¹ J: x, y, z.
struct UnitPushes {
  V force[3][3];  ///< the first three numbers are 0
  V torque[3][6];
};

HWY_INLINE UnitPushes unit_pushes(const Pass& pass, const BaseFactor& factor) {
  const Columns world = pass.world();
  const V3 axes[3] = {world.x, world.y, world.z};
  UnitPushes pushes;
  for (int d = 0; d < 3; ++d) {
    V w[6];
    to_array({zero3(), axes[d]}, w);
    solve_base(factor, w, 3);
    for (int i = 0; i < 3; ++i) pushes.force[d][i] = w[3 + i];
    to_array({axes[d], zero3()}, pushes.torque[d]);
    solve_base(factor, pushes.torque[d]);
  }
  return pushes;
}

/// Rows of a block before they are scaled to unit diagonal.
template <int N, int rows>
struct RowSet {
  V w[rows][capacity<N> + 6];
  V wanted[rows];
  Mask needed[rows];

  /// What is left of a row's W for the base, once the chain's part is known: less L_b⁻¹ B W.
  HWY_INLINE void finish_base(const ChainFactor& chain, int row, int first = 0) {
    for (int j = first; j < chain.n; ++j)
      for (int d = 0; d < 6; ++d)
        w[row][chain.n + d] = fnma(load(chain.base(j) + d * width), w[row][j], w[row][chain.n + d]);
  }

  /// Writes all but W, bounds and impulses; lanes that do not need a row get nothing from it.
  HWY_INLINE void scale(const Pass& pass, const Block& block, float relaxation) {
    const V softness = set(pass.model().cfm_s_per_kg / pass.batch.timestep_s);
    const V relaxed = set(1.0f / relaxation);
    V inverse[rows];
    for (int r = 0; r < rows; ++r) {
      V sum = softness;
      for (int i = 0; i < block.numbers; ++i) sum = fma(w[r][i], w[r][i], sum);
      const V root = hn::Sqrt(sum * relaxed);
      inverse[r] = hn::IfThenElseZero(needed[r], set(1.0f) / root);
      block.set(BlockShape::softness, r, softness * inverse[r] * inverse[r]);
      block.set(BlockShape::bias, r, wanted[r] * inverse[r]);
      block.set(BlockShape::root, r, root);
      block.set(BlockShape::inverse, r, inverse[r]);
      for (int i = 0; i < block.numbers; ++i) w[r][i] = w[r][i] * inverse[r];
      for (int s = 0; s < r; ++s) {
        V gram = zero();
        for (int i = 0; i < block.numbers; ++i) gram = fma(w[r][i], w[s][i], gram);
        block.set(BlockShape::gram, r + s - 1, gram);
      }
    }
  }

  /// Writes W, and moves Lᵀ ν by the impulses that the block starts with.
  HWY_INLINE void start(const Block& block, V* joints, V* base) const {
    const int n = block.numbers - 6;
    for (int r = 0; r < rows; ++r) {
      const V impulse = block.get(BlockShape::impulse, r);
      for (int i = 0; i < block.numbers; ++i) {
        V& number = i < n ? joints[i] : base[i - n];
        number = fma(w[r][i], impulse, number);
        store(w[r][i], block.w(r) + i * width);
      }
    }
  }
};

/// Motors and stops of up to three joints of a chain, from `first` on; false if no lane has one.
template <int N, int rows>
HWY_INLINE bool joint_block(const Pass& pass, const Chain& chain, const ChainFactor& factor, int first,
                            const Block& block, V* joints, V* base_free) {
  const int n = length<N>(chain);
  Mask needed = nowhere();
  RowSet<N, rows> set_of;
  for (int r = 0; r < rows; ++r) {
    const float* const servo = pass.scratch(pass.work().servos + 4 * (chain.first + first + r));
    set_of.needed[r] = load(servo + width) < load(servo + 2 * width);
    set_of.wanted[r] = load(servo);
    needed = hn::Or(needed, set_of.needed[r]);
  }
  if (hn::AllFalse(Floats(), hn::And(needed, pass.active()))) return false;
  for (int r = 0; r < rows; ++r) {
    const int j = first + r;
    V* const w = set_of.w[r];
    for (int i = 0; i < n + 6; ++i) w[i] = zero();
    w[j] = load(factor.inverse(j));
    for (int i = j + 1; i < n; ++i) {
      for (int k = j; k < i; ++k) w[i] = fnma(load(factor.lower(i, k)), w[k], w[i]);
      w[i] = w[i] * load(factor.inverse(i));
    }
    set_of.finish_base(factor, r, j);
  }
  set_of.scale(pass, block, pass.model().joint_relaxation);
  for (int r = 0; r < rows; ++r) {
    const float* const servo = pass.scratch(pass.work().servos + 4 * (chain.first + first + r));
    // An infinite bound stays so; 0 × root is 0.
    const V root = block.get(BlockShape::root, r);
    const V low = load(servo + width) * root, high = load(servo + 2 * width) * root;
    block.set(BlockShape::low, r, low);
    block.set(BlockShape::high, r, high);
    const V before = pass.state(pass.batch.rows.joint_impulse + chain.first + first + r) * root;
    block.set(BlockShape::impulse, r, hn::Max(hn::Min(before, high), low));
  }
  set_of.start(block, joints, base_free);
  return true;
}

/// Bounds of the impulses, and those of the step before within them.
HWY_INLINE void bound_contact(const Pass& pass, Mask touches, const Block& block) {
  const float friction = pass.model().friction;
  const V normal = hn::IfThenElseZero(
      touches, hn::Max(block.get(BlockShape::impulse) * block.get(BlockShape::root), zero()));
  block.set(BlockShape::impulse, 0, normal);
  for (int r = 1; r < 3; ++r) {
    V before =
        hn::IfThenElseZero(touches, block.get(BlockShape::impulse, r) * block.get(BlockShape::root, r));
    if (!std::isinf(friction)) {
      const V high = set(friction) * block.get(BlockShape::root, r) * block.get(BlockShape::inverse);
      const V most = high * normal;
      block.set(BlockShape::high, r, high);
      before = hn::Max(hn::Min(before, most), hn::Neg(most));
    }
    block.set(BlockShape::impulse, r, before);
  }
}

/// Where a point would touch the ground: from the centre of mass, torso axes.
template <int N>
HWY_INLINE V3 contact_position(const Pass& pass, const Point& point, const Chain* chain) {
  V3 at = pass.state3(Rows::origin) + set(point.position_m);
  if (N != 0) {
    const int row = pass.pose_row(chain->first + point.link);
    const Columns axes{pass.state3(row), pass.state3(row + 3), pass.state3(row + 6)};
    at = pass.state3(row + 9) + axes * set(point.position_m);
  }
  return fnma(set(point.radius_m), pass.state3(Rows::axes + 6), at);
}

/// Puts a touching point into each lane's next free block: there its position (torso axes), its impulses of
/// the step before, unscaled, its height as first bias and its link as second. `used`: blocks taken, by lane.
template <int N>
HWY_INLINE void assign_contact(const Pass& pass, int p, const Chain* chain, int n, Mask touches,
                               ChainBlocks& blocks, V& used) {
  const Point& point = pass.model().points[to_index(p)];
  const V3 at = contact_position<N>(pass, point, chain);
  const V3 before = pass.state3(pass.batch.rows.point_impulse + 3 * p);
  const V height = load(pass.scratch(pass.work().heights + p)), above = set(1.0f), none = zero();
  const V link = set(static_cast<float>(point.link));
  store(hn::IfThenElse(touches, used, set(-1.0f)), pass.scratch(pass.work().places + p));
  const V values[8] = {height, link, at.x, at.y, at.z, before.x, before.y, before.z};
  constexpr int fields[8] = {BlockShape::bias,         BlockShape::bias + 1,     BlockShape::position,
                             BlockShape::position + 1, BlockShape::position + 2, BlockShape::impulse,
                             BlockShape::impulse + 1,  BlockShape::impulse + 2};
  for (int b = blocks.joint_blocks;; ++b) {
    const Mask here = hn::And(touches, used == set(static_cast<float>(b - blocks.joint_blocks)));
    if (hn::AllFalse(Floats(), here)) {
      if (b >= blocks.count) break;
      continue;
    }
    const Block block = block_at(pass, blocks.first + b, n);
    const bool fresh = b == blocks.count;
    for (int f = 0; f < 8; ++f) {
      const V other = !fresh ? block.get(fields[f]) : f == 0 ? above : none;
      block.set(fields[f], 0, hn::IfThenElse(here, values[f], other));
    }
    if (fresh) ++blocks.count;
  }
  used = used + hn::IfThenElseZero(touches, set(1.0f));
}

/// The chain's part of W of unit forces along the world's z, y and x at a place of its link number `link`.
template <int N>
HWY_INLINE void push_chain(const Pass& pass, V link, const Chain* chain, const ChainFactor& factor,
                           const Columns& world, V3 at, RowSet<N, 3>& rows) {
  for (int j = 0; j < factor.n; ++j) {
    const Spatial joint = joint_motion(pass, *chain, j);
    const Mask carries = link >= set(static_cast<float>(j));
    const V3 way = cross(joint.turn, at, joint.push);
    V3 moved{hn::IfThenElseZero(carries, dot(world.z, way)), hn::IfThenElseZero(carries, dot(world.y, way)),
             hn::IfThenElseZero(carries, dot(world.x, way))};
    for (int k = 0; k < j; ++k) {
      const V lower = load(factor.lower(j, k));
      moved = fnma(lower, V3{rows.w[0][k], rows.w[1][k], rows.w[2][k]}, moved);
    }
    moved = load(factor.inverse(j)) * moved;
    rows.w[0][j] = moved.x;
    rows.w[1][j] = moved.y;
    rows.w[2][j] = moved.z;
  }
}

/// The base's part of the same, as if the chain were stiff: `at` along the world's axes.
template <int N>
HWY_INLINE void push_base(const UnitPushes& pushes, V3 at, int n, RowSet<N, 3>& rows) {
  const V(&torque)[3][6] = pushes.torque;
  for (int i = 0; i < 6; ++i) {
    const V x = torque[0][i], y = torque[1][i], z = torque[2][i];
    rows.w[0][n + i] = i < 3 ? at.y * x : fma(at.y, x, pushes.force[2][i - 3]);
    rows.w[0][n + i] = fnma(at.x, y, rows.w[0][n + i]);
    rows.w[1][n + i] = i < 3 ? at.x * z : fma(at.x, z, pushes.force[1][i - 3]);
    rows.w[1][n + i] = fnma(at.z, x, rows.w[1][n + i]);
    rows.w[2][n + i] = i < 3 ? at.z * y : fma(at.z, y, pushes.force[0][i - 3]);
    rows.w[2][n + i] = fnma(at.y, z, rows.w[2][n + i]);
  }
}

/// Rows of the contacts, one per lane, that were put into a block: as deep as their height is negative. Up,
/// then ODE's two friction directions, the world's y and x.
template <int N>
HWY_INLINE void contact_block(const Pass& pass, const Chain* chain, const ChainFactor& factor,
                              const UnitPushes& pushes, const Block& block, V* joints, V* base_free) {
  const Columns world = pass.world();
  const V height = block.get(BlockShape::bias);
  const V3 at{block.get(BlockShape::position, 0), block.get(BlockShape::position, 1),
              block.get(BlockShape::position, 2)};
  const V3 place = transposed(world, at);
  const Mask touches = height <= zero();
  RowSet<N, 3> rows;
  rows.wanted[0] = set(-pass.model().erp / pass.batch.timestep_s) * height;
  rows.wanted[1] = rows.wanted[2] = zero();
  for (Mask& needed : rows.needed) needed = touches;
  push_chain<N>(pass, block.get(BlockShape::bias, 1), chain, factor, world, at, rows);
  push_base<N>(pushes, place, factor.n, rows);
  for (int r = 0; r < 3; ++r) rows.finish_base(factor, r);
  rows.scale(pass, block, pass.model().contact_relaxation);
  block.set(BlockShape::position, 0, place.x);
  block.set(BlockShape::position, 1, place.y);
  block.set(BlockShape::position, 2, place.z);
  bound_contact(pass, touches, block);
  rows.start(block, joints, base_free);
}

/// Blocks of all contacts of the torso (segment 0, N = 0) or of a chain, behind those already there. Each
/// lane's touching points take the first blocks, in the order of the points: so there are only as many as one
/// lane has contacts, and a lane's first contact is in the first of them whoever shares the pass.
template <int N>
HWY_INLINE void contact_blocks(const Pass& pass, int segment, const Chain* chain, const ChainFactor& factor,
                               const UnitPushes& pushes, ChainBlocks& blocks, V* joints, V* base_free) {
  const Model& model = pass.model();
  const Mask active = pass.active();
  V used = zero();
  for (int g = model.first_geom[to_index(segment)]; g < model.first_geom[to_index(segment) + 1]; ++g) {
    const PointGroup& geom = model.geoms[to_index(g)];
    unsigned char& felt = pass.geom_felt(g);
    const bool near = pass.work().near[to_index(g)];
    if (!near && !felt) continue;
    bool any = false;
    for (int p = geom.first; p < geom.first + geom.count; ++p) {
      const Mask touches =
          near ? hn::And(load(pass.scratch(pass.work().heights + p)) <= zero(), active) : nowhere();
      if (hn::AllFalse(Floats(), touches)) {
        if (felt) store3(zero3(), pass.row(pass.batch.rows.point_impulse + 3 * p), pass.lane);
        store(set(-1.0f), pass.scratch(pass.work().places + p));
        continue;
      }
      any = true;
      assign_contact<N>(pass, p, chain, factor.n, touches, blocks, used);
    }
    felt = any;
  }
  for (int b = blocks.joint_blocks; b < blocks.count; ++b)
    contact_block<N>(pass, chain, factor, pushes, block_at(pass, blocks.first + b, factor.n), joints,
                     base_free);
}

/// Products of a contact's rows with those of its chain's motors, for blocks that are visited together.
HWY_INLINE void cross_products(const Block& motors, const Block& contact) {
  for (int s = 0; s < 3; ++s) {
    V sums[3] = {zero(), zero(), zero()};
    for (int i = s; i < 9; ++i) {
      const V w = load(motors.w(s) + i * width);
      for (int r = 0; r < 3; ++r) sums[r] = fma(w, load(contact.w(r) + i * width), sums[r]);
    }
    for (int r = 0; r < 3; ++r) contact.set(BlockShape::cross, 3 * s + r, sums[r]);
  }
}

/// All blocks of a chain, whose B becomes L_b⁻¹ B; its Lᵀ ν moves by the impulses they start with.
template <int N>
HWY_INLINE void chain_blocks(const Pass& pass, std::size_t c, const BaseFactor& base,
                             const UnitPushes& pushes, int first_block, V* base_free) {
  const Chain& chain = pass.model().chains[c];
  const int n = length<N>(chain);
  const ChainFactor factor{pass.scratch(pass.work().factors[c]), n};
  ChainBlocks& blocks = pass.work().chain_blocks[c + 1];
  blocks = {first_block, 0, 0};
  float* const free = pass.scratch(pass.work().free + chain.first);
  V joints[capacity<N>];
  for (int j = 0; j < n; ++j) joints[j] = load(free + j * width);
  for (int j = 0; j < n; ++j) {
    V rows[6];
    for (int d = 0; d < 6; ++d) rows[d] = load(factor.base(j) + d * width);
    solve_base(base, rows);
    for (int d = 0; d < 6; ++d) store(rows[d], factor.base(j) + d * width);
  }
  for (int j = 0; j < n; j += 3) {
    const Block block = block_at(pass, blocks.first + blocks.count, n);
    const int rows = n - j < 3 ? n - j : 3;
    bool any = false;
    if (rows == 3) any = joint_block<N, 3>(pass, chain, factor, j, block, joints, base_free);
    if (rows == 2) any = joint_block<N, 2>(pass, chain, factor, j, block, joints, base_free);
    if (rows == 1) any = joint_block<N, 1>(pass, chain, factor, j, block, joints, base_free);
    if (!any) {
      for (int r = j; r < j + rows; ++r)
        pass.set_state(pass.batch.rows.joint_impulse + chain.first + r, zero());
      continue;
    }
    pass.work().block_joint[to_index(blocks.first + blocks.count)] = j;
    ++blocks.joint_blocks;
    ++blocks.count;
  }
  contact_blocks<N>(pass, static_cast<int>(c) + 1, &chain, factor, pushes, blocks, joints, base_free);
  if (N == 3 && blocks.paired())
    cross_products(block_at(pass, blocks.first, n), block_at(pass, blocks.first + 1, n));
  for (int j = 0; j < n; ++j) store(joints[j], free + j * width);
}

template <int N>
HWY_NOINLINE void all_blocks(const Pass& pass, const BaseFactor& base, V* base_free) {
  const UnitPushes pushes = unit_pushes(pass, base);
  ChainBlocks& torso = pass.work().chain_blocks[0];
  torso = {0, 0, 0};
  V none[1];
  contact_blocks<0>(pass, 0, nullptr, {nullptr, 0}, pushes, torso, none, base_free);
  int first = torso.count;
  for (std::size_t c = 0; c < pass.model().chains.size(); ++c) {
    chain_blocks<N>(pass, c, base, pushes, first, base_free);
    first += pass.work().chain_blocks[c + 1].count;
  }
}

}  // namespace amble::physics::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggled by HWY_TARGET_TOGGLE
