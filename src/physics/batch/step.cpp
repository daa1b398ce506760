#include "amble/physics/batch/step.hpp"

#include <cmath>

#include "amble/core/index.hpp"
#include "amble/physics/batch/denormals.hpp"

// Instruction sets that would only repeat the code of their neighbours, or have no fixed width.
#ifdef AMBLE_FEW_INSTRUCTION_SETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3 | HWY_AVX3_DL)
#else
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_RVV)
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "amble/physics/batch/step.cpp"
#include <hwy/foreach_target.h>

#include "amble/physics/batch/solver-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::physics::batch::HWY_NAMESPACE {

/// Beyond this a robot has exploded: m/s or rad/s (Engine::healthy).
constexpr float absurd_speed = 1000.0f;

/// x + 0 turns −0 into 0: a block that is skipped must leave the same bits as a block that does nothing.
HWY_INLINE V plain(V x) {
  return x + zero();
}

/// Keeps the impulses of a chain's motors and stops for the next step.
inline void keep_joint_impulses(const Pass& pass, const ChainBlocks& blocks, const Chain& chain) {
  for (int b = 0; b < blocks.joint_blocks; ++b) {
    const Block block = block_at(pass, blocks.first + b, chain.count);
    const int first = pass.work().block_joint[to_index(blocks.first + b)];
    for (int r = 0; r < 3 && first + r < chain.count; ++r)
      pass.set_state(pass.batch.rows.joint_impulse + chain.first + first + r,
                     plain(block.get(BlockShape::impulse, r) * block.get(BlockShape::inverse, r)));
  }
}

/// Keeps each point's impulses, which stand, no longer scaled, in the blocks that its lanes gave it.
inline void keep_point_impulses(const Pass& pass, const ChainBlocks& blocks, std::size_t segment, int n) {
  const Model& model = pass.model();
  if (blocks.count == blocks.joint_blocks) return;
  for (int g = model.first_geom[segment]; g < model.first_geom[segment + 1]; ++g) {
    if (!pass.geom_felt(g)) continue;
    const PointGroup& geom = model.geoms[to_index(g)];
    for (int p = geom.first; p < geom.first + geom.count; ++p) {
      const V place = load(pass.scratch(pass.work().places + p));
      V3 impulse = zero3();
      for (int b = blocks.joint_blocks; b < blocks.count; ++b) {
        const Mask here = place == set(static_cast<float>(b - blocks.joint_blocks));
        const Block block = block_at(pass, blocks.first + b, n);
        impulse.x = hn::IfThenElse(here, block.get(BlockShape::impulse, 0), impulse.x);
        impulse.y = hn::IfThenElse(here, block.get(BlockShape::impulse, 1), impulse.y);
        impulse.z = hn::IfThenElse(here, block.get(BlockShape::impulse, 2), impulse.z);
      }
      store3(impulse, pass.row(pass.batch.rows.point_impulse + 3 * p), pass.lane);
    }
  }
}

/// Keeps the impulses for the next step, and adds up what ground and push gave: force × time, and torque ×
/// time about the centre of mass, both along world axes.
inline void collect_impulses(const Pass& pass, V3& push, V3& turn) {
  const Model& model = pass.model();
  const Columns world = pass.world();
  push = pass.state3(Rows::push);
  turn = transposed(world, cross(pass.state3(Rows::origin) + set(model.torso.com_m), world * push));
  for (std::size_t segment = 0; segment < pass.work().chain_blocks.size(); ++segment) {
    const ChainBlocks& blocks = pass.work().chain_blocks[segment];
    const Chain chain = segment == 0 ? Chain{} : model.chains[segment - 1];
    keep_joint_impulses(pass, blocks, chain);
    for (int b = blocks.joint_blocks; b < blocks.count; ++b) {
      const Block block = block_at(pass, blocks.first + b, chain.count);
      V impulse[3];
      for (int r = 0; r < 3; ++r) {
        impulse[r] = plain(block.get(BlockShape::impulse, r) * block.get(BlockShape::inverse, r));
        block.set(BlockShape::impulse, r, impulse[r]);
      }
      const V3 force{impulse[2], impulse[1], impulse[0]};
      const V3 at{block.get(BlockShape::position, 0), block.get(BlockShape::position, 1),
                  block.get(BlockShape::position, 2)};
      push = push + force;
      turn = cross(at, force, turn);
    }
    keep_point_impulses(pass, blocks, segment, chain.count);
  }
}

/// The next state, before it is known which lanes take it.
struct Next {
  const Pass& pass;
  Mask active;

  void put(int row, V v) const { pass.set_state(row, hn::IfThenElse(active, plain(v), pass.state(row))); }
  void put3(int row, V3 v) const {
    put(row, v.x);
    put(row + 1, v.y);
    put(row + 2, v.z);
  }
};

/// Position + what it lost before + way, and what the sum loses now (two-sum).
HWY_INLINE void advance(const Next& next, int index, V velocity) {
  const V high = next.pass.state(Rows::com + index);
  const V way = fma(set(next.pass.batch.timestep_s), velocity, next.pass.state(Rows::com_rest + index));
  const V sum = high + way;
  const V part = sum - high;
  next.put(Rows::com + index, sum);
  next.put(Rows::com_rest + index, (high - (sum - part)) + (way - part));
}

HWY_INLINE void turn_torso(const Next& next, V3 turn) {
  const Pass& pass = next.pass;
  const V3 d = set(0.5f * pass.batch.timestep_s) * turn;
  const V w = pass.state(Rows::rotation);
  const V3 q = pass.state3(Rows::rotation + 1);
  const V w_next = fnma(q.z, d.z, fnma(q.y, d.y, fnma(q.x, d.x, w)));
  const V3 q_next = cross(q, d, fma(w, d, q));
  const V scale = set(1.0f) / hn::Sqrt(dot(q_next, q_next, w_next * w_next));
  next.put(Rows::rotation, scale * w_next);
  next.put3(Rows::rotation + 1, scale * q_next);
}

/// Speeds of the joints out of Lᵀ ν (its base's part `base`), and their angles. Adds the squares of the
/// speeds.
template <int N>
HWY_INLINE V turn_joints(const Next& next, std::size_t c, const V* base, V fastest) {
  const Pass& pass = next.pass;
  const Chain& chain = pass.model().chains[c];
  const int n = length<N>(chain);
  const ChainFactor factor{pass.scratch(pass.work().factors[c]), n};
  V speed[capacity<N>];
  for (int j = n - 1; j >= 0; --j) {
    V x = load(pass.scratch(pass.work().free + chain.first + j));
    for (int d = 0; d < 6; ++d) x = fnma(load(factor.base(j) + d * width), base[d], x);
    for (int i = j + 1; i < n; ++i) x = fnma(load(factor.lower(i, j)), speed[i], x);
    speed[j] = x * load(factor.inverse(j));
    // A sum is not a number as soon as one of its terms is not; a maximum may be one.
    fastest = fma(speed[j], speed[j], fastest);
    const int angle = pass.batch.rows.angle + chain.first + j;
    next.put(angle, fma(set(pass.batch.timestep_s), speed[j], pass.state(angle)));
    next.put(pass.batch.rows.speed + chain.first + j, speed[j]);
  }
  return fastest;
}

/// Velocities after the constraints, and positions after them.
template <int N>
HWY_NOINLINE void integrate(const Pass& pass, const BaseFactor& factor, V* motion) {
  const Model& model = pass.model();
  const Next next{pass, pass.active()};
  V3 push, turn;
  collect_impulses(pass, push, turn);
  V fastest = zero();
  for (std::size_t c = 0; c < model.chains.size(); ++c) fastest = turn_joints<N>(next, c, motion, fastest);
  solve_base_transposed(factor, motion);

  const V3 gained =
      fma(set(1.0f / model.mass_kg), push, set(pass.batch.timestep_s) * set(model.gravity_m_s2));
  const V3 velocity = pass.state3(Rows::velocity) + gained;
  next.put3(Rows::velocity, velocity);
  next.put3(Rows::spin, pass.state3(Rows::spin) + turn);
  advance(next, 0, velocity.x);
  advance(next, 1, velocity.y);
  advance(next, 2, velocity.z);
  next.put3(Rows::push, zero3());
  const V3 spin{motion[0], motion[1], motion[2]};
  turn_torso(next, spin);

  const V limit = set(absurd_speed * absurd_speed);
  const float joint_limit = absurd_speed * absurd_speed * static_cast<float>(model.links.size() + 1);
  Mask sane = hn::And(dot(velocity, velocity) <= limit, dot(spin, spin) <= limit);
  sane = hn::And(sane, fastest <= set(joint_limit));
  next.put(Rows::healthy, hn::IfThenElseZero(sane, pass.state(Rows::healthy)));
}

/// What the motors gave. Where a servo's row has finite bounds it is the motor's, else that of a stop.
HWY_NOINLINE void tell_torques(const Pass& pass) {
  const V rate = set(1.0f / pass.batch.timestep_s);
  for (int l = 0; l < pass.batch.rows.links; ++l) {
    const float* const servo = pass.scratch(pass.work().servos + 4 * l);
    const Mask motor =
        load(servo + 2 * width) - load(servo + width) < set(std::numeric_limits<float>::infinity());
    const V impulse = hn::IfThenElseZero(motor, pass.state(pass.batch.rows.joint_impulse + l));
    const V torque = fma(rate, impulse, load(servo + 3 * width));
    const int joint = pass.model().links[to_index(l)].joint;
    hn::StoreU(torque, Floats(), pass.batch.torques_nm->row(joint) + pass.lane);
  }
}

template <int N>
HWY_INLINE void step_chains(const Pass& pass, const LaneArray& targets_rad) {
  find_touch(pass);
  Base base = weigh<N>(pass);
  find_inertial_forces<N>(pass, base);
  BaseFactor factor;
  V base_free[6];
  free_motion<N>(pass, targets_rad, base, factor, base_free);
  all_blocks<N>(pass, factor, base_free);
  if (std::isinf(pass.model().friction)) {
    solve<N, Bound::stuck>(pass, base_free);
  } else {
    solve<N, Bound::cone>(pass, base_free);
  }
  integrate<N>(pass, factor, base_free);
}

/// Chains of three joints, the quadruped's and most hexapods', are worth code of their own.
void step_lanes(const Batch& batch, const LaneArray& targets_rad) {
  const bool threes = batch.model.equal_chains && batch.model.longest_chain == 3;
  for (int lane = 0; lane < lanes; lane += width) {
    const Pass pass{batch, lane};
    if (hn::AllFalse(Floats(), pass.active())) continue;
    if (threes) {
      step_chains<3>(pass, targets_rad);
    } else {
      step_chains<-1>(pass, targets_rad);
    }
    if (batch.torques_nm != nullptr) tell_torques(pass);
    find_pose(pass);
    read_sensors(pass);
  }
}

void derive_lanes(const Batch& batch) {
  for (int lane = 0; lane < lanes; lane += width) {
    const Pass pass{batch, lane};
    find_pose(pass);
    find_touch(pass);
    read_sensors(pass);
  }
}

void sine_cosine_array(const float* angles, float* sines, float* cosines, int count) {
  for (int i = 0; i < count; i += width) {
    const SineCosine both = sine_cosine(hn::LoadU(Floats(), angles + i));
    hn::StoreU(both.sine, Floats(), sines + i);
    hn::StoreU(both.cosine, Floats(), cosines + i);
  }
}

void arc_tangent_array(const float* y, const float* x, float* angles, int count) {
  for (int i = 0; i < count; i += width)
    hn::StoreU(arc_tangent(hn::LoadU(Floats(), y + i), hn::LoadU(Floats(), x + i)), Floats(), angles + i);
}

}  // namespace amble::physics::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace amble::physics::batch {

HWY_EXPORT(step_lanes);
HWY_EXPORT(derive_lanes);
HWY_EXPORT(sine_cosine_array);
HWY_EXPORT(arc_tangent_array);

void step(const Batch& batch, const LaneArray& targets_rad) {
  const DenormalsAreZero guard;
  HWY_DYNAMIC_DISPATCH(step_lanes)(batch, targets_rad);
}

void derive(const Batch& batch) {
  const DenormalsAreZero guard;
  HWY_DYNAMIC_DISPATCH(derive_lanes)(batch);
}

void sine_cosine(const float* angles_rad, float* sines, float* cosines, int count) {
  HWY_DYNAMIC_DISPATCH(sine_cosine_array)(angles_rad, sines, cosines, count);
}

void arc_tangent(const float* y, const float* x, float* angles_rad, int count) {
  HWY_DYNAMIC_DISPATCH(arc_tangent_array)(y, x, angles_rad, count);
}

}  // namespace amble::physics::batch
#endif
