// Constraint rows of contacts, and all blocks of a robot in the order of the solver; for each instruction
// set.
#if defined(AMBLE_BATCH_CONTACTS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef AMBLE_BATCH_CONTACTS_INL_HPP
#undef AMBLE_BATCH_CONTACTS_INL_HPP
#else
#define AMBLE_BATCH_CONTACTS_INL_HPP
#endif

#include <cmath>

#include "amble/core/index.hpp"
#include "amble/physics/batch/constraints-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::physics::batch::HWY_NAMESPACE {

/// L_b⁻¹ J_bᵀ of unit forces and unit torques on the base along the world's axes e: J_bᵀ = (0, e) and (e, 0).
/// Found once per step; a contact's is a combination of them.
struct UnitWrenches {
  V force[3][3];  ///< linear entries; the angular ones are 0
  V torque[3][6];
};

HWY_INLINE UnitWrenches unit_wrenches(const Pass& pass, const BaseFactor& factor) {
  const Columns world = pass.world();
  const V3 axes[3] = {world.x, world.y, world.z};
  UnitWrenches wrenches;
  for (int d = 0; d < 3; ++d) {
    V w[6];
    to_array({zero3(), axes[d]}, w);
    solve_base(factor, w, 3);
    for (int i = 0; i < 3; ++i) wrenches.force[d][i] = w[3 + i];
    to_array({axes[d], zero3()}, wrenches.torque[d]);
    solve_base(factor, wrenches.torque[d]);
  }
  return wrenches;
}

/// Bounds of a contact's impulses, and those of the last step clamped to them: p_n ≥ 0, |p_t| ≤ μ p_n for
/// each of the two friction rows (a pyramid, as ODE's dContactApprox1).
HWY_INLINE void bound_contact(const Pass& pass, Mask touches, const Block& block) {
  const float friction = pass.model().friction;
  const V normal = hn::IfThenElseZero(
      touches, max(block.get(BlockLayout::impulse) * block.get(BlockLayout::scale), zero()));
  block.set(BlockLayout::impulse, 0, normal);
  for (int r = 1; r < 3; ++r) {
    V impulse =
        hn::IfThenElseZero(touches, block.get(BlockLayout::impulse, r) * block.get(BlockLayout::scale, r));
    if (!std::isinf(friction)) {
      const V high = set(friction) * block.get(BlockLayout::scale, r) * block.get(BlockLayout::inverse_scale);
      const V limit = high * normal;
      block.set(BlockLayout::high, r, high);
      impulse = max(min(impulse, limit), hn::Neg(limit));
    }
    block.set(BlockLayout::impulse, r, impulse);
  }
}

HWY_INLINE V3 load_normal(const float* from) {
  return {load(from), load(from + width), load(from + 2 * width)};
}

/// A contact's normal n and the directions of its friction, n₁ ∝ x × n and n₂ = n₁ × n (y and x on the
/// plane), world axes.
struct ContactFrame {
  V3 normal, first, second;
};

HWY_INLINE ContactFrame contact_frame(const Pass& pass, int block) {
  const V3 n = load_normal(pass.scratch(pass.work().block_normal + 3 * block));
  const V scale = set(1.0f) / hn::Sqrt(fma(n.y, n.y, n.z * n.z));
  const V3 first{zero(), scale * n.z, hn::Neg(scale * n.y)};
  return {n, first, cross(first, n)};
}

/// Where a point touches the ground, relative to the centre of mass, torso axes (m): its lowest place, or on
/// uneven ground that in the direction of its normal, point number `p`'s.
template <int N>
HWY_INLINE V3 contact_position(const Pass& pass, int p, const Chain* chain) {
  const Point& point = pass.model().points[to_index(p)];
  const V3 up = pass.state3(StateRows::world_axes + 6);
  V3 position;
  if (N == 0) {
    position = pass.state3(StateRows::torso_origin) + point_position(point, up);
  } else {
    const int row = pass.pose_row(chain->first + point.link);
    const Columns axes{pass.state3(row), pass.state3(row + 3), pass.state3(row + 6)};
    position = pass.state3(row + 9) + axes * point_position(point, transposed(axes, up));
  }
  const V3 normal =
      pass.ground() ? pass.world() * load_normal(pass.scratch(pass.work().point_normal + 3 * p)) : up;
  return fnma(set(point.radius_m), normal, position);
}

/// Stores a point's normal as a block's in the lanes `here`; a new block's is upright in the others.
HWY_INLINE void assign_normal(const Pass& pass, int p, int block, Mask here, bool is_new) {
  const float* const from = pass.scratch(pass.work().point_normal + 3 * p);
  float* const to = pass.scratch(pass.work().block_normal + 3 * block);
  for (int d = 0; d < 3; ++d) {
    const V other = !is_new ? load(to + d * width) : d == 2 ? set(1.0f) : zero();
    store(hn::IfThenElse(here, load(from + d * width), other), to + d * width);
  }
}

/// Assigns a touching point to each lane's next free block, and stores there what contact_block() needs: its
/// position (torso axes) as `arm`, its impulses of the last step, unscaled, its height as first target and
/// its link as second. `used`: number of blocks taken, by lane.
template <int N>
HWY_INLINE void assign_contact(const Pass& pass, int p, const Chain* chain, int n, Mask touches,
                               ChainBlocks& blocks, V& used) {
  const Point& point = pass.model().points[to_index(p)];
  const V3 position = contact_position<N>(pass, p, chain);
  const V3 impulse = pass.state3(pass.rows().point_impulse + 3 * p);
  const V height = load(pass.scratch(pass.work().point_height + p)), above_ground = set(1.0f), none = zero();
  const V link = set(static_cast<float>(point.link));
  store(hn::IfThenElse(touches, used, set(-1.0f)), pass.scratch(pass.work().point_slot + p));
  const V values[8] = {height, link, position.x, position.y, position.z, impulse.x, impulse.y, impulse.z};
  constexpr int fields[8] = {BlockLayout::target,      BlockLayout::target + 1, BlockLayout::arm,
                             BlockLayout::arm + 1,     BlockLayout::arm + 2,    BlockLayout::impulse,
                             BlockLayout::impulse + 1, BlockLayout::impulse + 2};
  for (int b = blocks.joint_blocks;; ++b) {
    const Mask here = hn::And(touches, used == set(static_cast<float>(b - blocks.joint_blocks)));
    if (hn::AllFalse(Floats(), here)) {
      if (b >= blocks.count) break;
      continue;
    }
    const Block block = block_at(pass, blocks.first + b, n);
    const bool is_new = b == blocks.count;
    for (int f = 0; f < 8; ++f) {
      const V other = !is_new ? block.get(fields[f]) : f == 0 ? above_ground : none;
      block.set(fields[f], 0, hn::IfThenElse(here, values[f], other));
    }
    if (pass.ground()) assign_normal(pass, p, blocks.first + b, here, is_new);
    if (is_new) ++blocks.count;
  }
  used = used + hn::IfThenElseZero(touches, set(1.0f));
}

/// Rows along the world's z, y and x, turned into rows along a contact's normal and its directions of
/// friction.
HWY_INLINE V3 turned(const ContactFrame& frame, V3 w) {
  const V3 forces{w.z, w.y, w.x};
  return {dot(frame.normal, forces), dot(frame.first, forces), dot(frame.second, forces)};
}

/// Writes a column of a contact's rows; `frame` is null on the plane.
template <int N>
HWY_INLINE void put_contact_column(ConstraintRows<N, 3>& rows, int column, V3 w, const ContactFrame* frame) {
  if (frame != nullptr) w = turned(*frame, w);
  const V all[3] = {w.x, w.y, w.z};
  rows.put(column, all);
}

/// W_c = L_c⁻¹ J_cᵀ of unit forces along the world's z, y and x at `position` (torso axes) on link number
/// `link` of its chain. Entry j of J_c is the velocity of that point r per unit speed of joint j,
/// a_j × r + c_j × a_j, or 0 where the joint does not carry the link.
template <int N>
HWY_INLINE void put_chain_columns(const Pass& pass, V link, const Chain* chain, const ChainFactor& factor,
                                  const Columns& world, V3 position, const ContactFrame* frame,
                                  ConstraintRows<N, 3>& rows) {
  for (int j = 0; j < factor.n; ++j) {
    const Spatial subspace = motion_subspace(pass, *chain, j);
    Mask carries = link >= set(static_cast<float>(j));
    if constexpr (N < 0)
      carries = hn::And(carries, link <= set(static_cast<float>(pass.link(*chain, j).last)));
    const V3 velocity = cross(subspace.angular, position, subspace.linear);
    V3 w{hn::IfThenElseZero(carries, dot(world.z, velocity)),
         hn::IfThenElseZero(carries, dot(world.y, velocity)),
         hn::IfThenElseZero(carries, dot(world.x, velocity))};
    for (int k = 0; k < j; ++k)
      w = fnma(load(factor.lower(j, k)), V3{rows.w_chain[k][0], rows.w_chain[k][1], rows.w_chain[k][2]}, w);
    w = load(factor.inverse(j)) * w;
    rows.w_chain[j][0] = w.x;
    rows.w_chain[j][1] = w.y;
    rows.w_chain[j][2] = w.z;
    put_contact_column(rows, j, w, frame);
  }
}

/// W_b = L_b⁻¹ J_bᵀ − (L_b⁻¹ B_c) W_c of the same at r = `arm` (world axes). A force e at r is the wrench
/// (r × e, e): for z, y and x the unit force, and of the unit torques r_y x − r_x y, r_x z − r_z x, r_z y −
/// r_y z.
template <int N>
HWY_INLINE void put_base_columns(const UnitWrenches& wrenches, V3 arm, const ChainFactor& factor,
                                 const ContactFrame* frame, ConstraintRows<N, 3>& rows) {
  const V(&torque)[3][6] = wrenches.torque;
  for (int i = 0; i < 6; ++i) {
    const V x = torque[0][i], y = torque[1][i], z = torque[2][i];
    V3 w;
    w.x = i < 3 ? arm.y * x : fma(arm.y, x, wrenches.force[2][i - 3]);
    w.x = fnma(arm.x, y, w.x);
    w.y = i < 3 ? arm.x * z : fma(arm.x, z, wrenches.force[1][i - 3]);
    w.y = fnma(arm.z, x, w.y);
    w.z = i < 3 ? arm.z * y : fma(arm.z, y, wrenches.force[0][i - 3]);
    w.z = fnma(arm.y, z, w.z);
    for (int j = 0; j < factor.n; ++j)
      w = fnma(load(factor.base(j) + i * width),
               V3{rows.w_chain[j][0], rows.w_chain[j][1], rows.w_chain[j][2]}, w);
    put_contact_column(rows, factor.n + i, w, frame);
  }
}

/// Builds the rows of the contacts, one per lane, that were assigned to a block: normal along the world's z
/// with target (erp/h) depth, then friction along the world's y and x (ODE's directions) with target 0; on
/// uneven ground along the directions of its ContactFrame.
template <int N>
HWY_INLINE void contact_block(const Pass& pass, const Chain* chain, const ChainFactor& factor,
                              const UnitWrenches& wrenches, int index, V* u_joints, V* u_base) {
  const Block block = block_at(pass, index, factor.n);
  const Columns world = pass.world();
  const V height = block.get(BlockLayout::target), link = block.get(BlockLayout::target, 1);
  const V3 position{block.get(BlockLayout::arm, 0), block.get(BlockLayout::arm, 1),
                    block.get(BlockLayout::arm, 2)};
  const V3 arm = transposed(world, position);
  const Mask touches = height <= zero();
  ConstraintRows<N, 3> rows(block);
  rows.target[0] = set(-pass.model().erp / pass.timestep_s()) * height;
  rows.target[1] = rows.target[2] = zero();
  for (Mask& enabled : rows.enabled) enabled = touches;
  for (V& softness : rows.softness) softness = set(pass.model().cfm_s_per_kg / pass.timestep_s());
  rows.begin();
  const bool uneven = pass.ground() != nullptr;
  const ContactFrame uneven_frame = uneven ? contact_frame(pass, index) : ContactFrame{};
  const ContactFrame* const frame = uneven ? &uneven_frame : nullptr;
  put_chain_columns<N>(pass, link, chain, factor, world, position, frame, rows);
  put_base_columns<N>(wrenches, arm, factor, frame, rows);
  rows.find_scales(pass.model().contact_relaxation);
  block.set(BlockLayout::arm, 0, arm.x);
  block.set(BlockLayout::arm, 1, arm.y);
  block.set(BlockLayout::arm, 2, arm.z);
  bound_contact(pass, touches, block);
  rows.scale_and_start(u_joints, u_base);
}

/// Blocks of all contacts of the torso (segment 0, N = 0) or of a chain, after those of its joints. In each
/// lane touching points take the first blocks, in the order of the points. So there are only as many blocks
/// as the lane with most contacts has, and a lane's first contact is in the first of them whatever the other
/// lanes of the pass do.
template <int N>
HWY_INLINE void contact_blocks(const Pass& pass, int segment, const Chain* chain, const ChainFactor& factor,
                               const UnitWrenches& wrenches, ChainBlocks& blocks, V* u_joints, V* u_base) {
  const Model& model = pass.model();
  const Mask active = pass.active();
  V used = zero();
  for (int g = model.first_geom[to_index(segment)]; g < model.first_geom[to_index(segment) + 1]; ++g) {
    const PointGroup& geom = model.geoms[to_index(g)];
    unsigned char& has_impulse = pass.geom_has_impulse(g);
    const bool may_touch = pass.work().geom_may_touch[to_index(g)];
    if (!may_touch && !has_impulse) continue;
    bool any = false;
    for (int p = geom.first; p < geom.first + geom.count; ++p) {
      const Mask touches = may_touch
                               ? hn::And(load(pass.scratch(pass.work().point_height + p)) <= zero(), active)
                               : no_lanes();
      if (hn::AllFalse(Floats(), touches)) {
        if (has_impulse) store3(zero3(), pass.row(pass.rows().point_impulse + 3 * p), pass.lane);
        store(set(-1.0f), pass.scratch(pass.work().point_slot + p));
        continue;
      }
      any = true;
      assign_contact<N>(pass, p, chain, factor.n, touches, blocks, used);
    }
    has_impulse = any;
  }
  for (int b = blocks.joint_blocks; b < blocks.count; ++b)
    contact_block<N>(pass, chain, factor, wrenches, blocks.first + b, u_joints, u_base);
}

/// W · W of a contact's rows and its chain's three motors, for blocks that are relaxed together.
HWY_INLINE void cross_products(const Block& motors, const Block& contact) {
  for (int s = 0; s < 3; ++s) {
    V sums[3] = {zero(), zero(), zero()};
    for (int i = s; i < 9; ++i) {
      const V w = load(motors.w(s) + i * width);
      for (int r = 0; r < 3; ++r) sums[r] = fma(w, load(contact.w(r) + i * width), sums[r]);
    }
    for (int r = 0; r < 3; ++r) contact.set(BlockLayout::cross_gram, 3 * s + r, sums[r]);
  }
}

/// B_c ← L_b⁻¹ B_c, column by column, which completes every row's W_b.
HWY_INLINE void solve_base_rows(const BaseFactor& base, const ChainFactor& factor) {
  for (int j = 0; j < factor.n; ++j) {
    V rows[6];
    for (int d = 0; d < 6; ++d) rows[d] = load(factor.base(j) + d * width);
    solve_base(base, rows);
    for (int d = 0; d < 6; ++d) store(rows[d], factor.base(j) + d * width);
  }
}

/// All blocks of a chain, from `first_block` on. Replaces its B_c by L_b⁻¹ B_c.
template <int N, Rows relaxed>
HWY_INLINE void build_chain_blocks(const Pass& pass, std::size_t c, const BaseFactor& base,
                                   const UnitWrenches& wrenches, int first_block, V* u_base) {
  const Chain& chain = pass.model().chains[c];
  const int n = length<N>(chain);
  const ChainFactor factor{pass.scratch(pass.work().factors[c]), n};
  ChainBlocks& blocks = pass.work().chain_blocks[c + 1];
  blocks = {first_block, 0, 0};
  float* const u_chain = pass.scratch(pass.work().u_joints + chain.first);
  V u_joints[capacity<N>];
  for (int j = 0; j < n; ++j) u_joints[j] = load(u_chain + j * width);
  solve_base_rows(base, factor);
  joint_blocks<N, relaxed>(pass, chain, factor, blocks, u_joints, u_base);
  contact_blocks<N>(pass, static_cast<int>(c) + 1, &chain, factor, wrenches, blocks, u_joints, u_base);
  if (relaxed == Rows::together && blocks.paired())
    cross_products(block_at(pass, blocks.first, n), block_at(pass, blocks.first + 1, n));
  for (int j = 0; j < n; ++j) store(u_joints[j], u_chain + j * width);
}

/// All blocks, warm-started: torso first, then chain by chain.
template <int N, Rows relaxed>
HWY_NOINLINE void build_blocks(const Pass pass, const BaseFactor& base, V* u_base) {
  const UnitWrenches wrenches = unit_wrenches(pass, base);
  ChainBlocks& torso = pass.work().chain_blocks[0];
  torso = {0, 0, 0};
  V none[1];
  contact_blocks<0>(pass, 0, nullptr, {nullptr, 0}, wrenches, torso, none, u_base);
  int first = torso.count;
  for (std::size_t c = 0; c < pass.model().chains.size(); ++c) {
    build_chain_blocks<N, relaxed>(pass, c, base, wrenches, first, u_base);
    first += pass.work().chain_blocks[c + 1].count;
  }
}

}  // namespace amble::physics::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggled by HWY_TARGET_TOGGLE
