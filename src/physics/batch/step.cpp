#include "amble/physics/batch/step.hpp"

#include <cmath>
#include <limits>

#include "amble/core/index.hpp"
#include "amble/core/simd_targets.hpp"
#include "amble/physics/batch/denormals.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "amble/physics/batch/step.cpp"
#include <hwy/foreach_target.h>

#include "amble/physics/batch/solver-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::physics::batch::HWY_NAMESPACE {

/// x + 0 turns −0 into 0: a block that is skipped must leave the same bits as one whose impulses are 0.
HWY_INLINE V without_negative_zero(V x) {
  return x + zero();
}

/// Stores the impulses of a chain's joint rows, unscaled, for the next step.
inline void store_joint_impulses(const Pass& pass, const ChainBlocks& blocks, const Chain& chain) {
  for (int b = 0; b < blocks.joint_blocks; ++b) {
    const Block block = block_at(pass, blocks.first + b, chain.count);
    const int first = pass.work().block_joint[to_index(blocks.first + b)];
    for (int r = 0; r < 3 && first + r < blocks.joint_rows; ++r)
      pass.set_state(pass.rows().joint_impulse + chain.first_row + first + r,
                     without_negative_zero(block.get(BlockLayout::impulse, r) *
                                           block.get(BlockLayout::inverse_scale, r)));
  }
}

/// Stores the impulses of each point for the next step, from the block assigned to it in each lane, where
/// they are no longer scaled.
inline void store_point_impulses(const Pass& pass, const ChainBlocks& blocks, std::size_t segment, int n) {
  const Model& model = pass.model();
  if (blocks.count == blocks.joint_blocks) return;
  for (int g = model.first_geom[segment]; g < model.first_geom[segment + 1]; ++g) {
    if (!pass.geom_has_impulse(g)) continue;
    const PointGroup& geom = model.geoms[to_index(g)];
    for (int p = geom.first; p < geom.first + geom.count; ++p) {
      const V slot = load(pass.scratch(pass.work().point_slot + p));
      V3 impulse = zero3();
      for (int b = blocks.joint_blocks; b < blocks.count; ++b) {
        const Mask here = slot == set(static_cast<float>(b - blocks.joint_blocks));
        const Block block = block_at(pass, blocks.first + b, n);
        impulse.x = hn::IfThenElse(here, block.get(BlockLayout::impulse, 0), impulse.x);
        impulse.y = hn::IfThenElse(here, block.get(BlockLayout::impulse, 1), impulse.y);
        impulse.z = hn::IfThenElse(here, block.get(BlockLayout::impulse, 2), impulse.z);
      }
      store3(impulse, pass.row(pass.rows().point_impulse + 3 * p), pass.lane);
    }
  }
}

/// Stores all impulses for the next step, and returns the total external impulse of ground and push about the
/// robot's centre of mass, Σ (r × p, p), world axes (N m s, N s).
inline Spatial collect_impulses(const Pass pass) {
  const Model& model = pass.model();
  const Columns world = pass.world();
  V3 linear = pass.state3(StateRows::push_impulse);
  V3 angular =
      transposed(world, cross(pass.state3(StateRows::torso_origin) + set(model.torso.com_m), world * linear));
  for (std::size_t segment = 0; segment < pass.work().chain_blocks.size(); ++segment) {
    const ChainBlocks& blocks = pass.work().chain_blocks[segment];
    const Chain chain = segment == 0 ? Chain{} : model.chains[segment - 1];
    store_joint_impulses(pass, blocks, chain);
    for (int b = blocks.joint_blocks; b < blocks.count; ++b) {
      const Block block = block_at(pass, blocks.first + b, chain.count);
      V row_impulse[3];
      for (int r = 0; r < 3; ++r) {
        row_impulse[r] = without_negative_zero(block.get(BlockLayout::impulse, r) *
                                               block.get(BlockLayout::inverse_scale, r));
        block.set(BlockLayout::impulse, r, row_impulse[r]);
      }
      V3 impulse{row_impulse[2], row_impulse[1], row_impulse[0]};
      if (pass.ground()) {
        const ContactFrame frame = contact_frame(pass, blocks.first + b);
        impulse = fma(row_impulse[0], frame.normal,
                      fma(row_impulse[1], frame.first, row_impulse[2] * frame.second));
      }
      const V3 arm{block.get(BlockLayout::arm, 0), block.get(BlockLayout::arm, 1),
                   block.get(BlockLayout::arm, 2)};
      linear = linear + impulse;
      angular = cross(arm, impulse, angular);
    }
    store_point_impulses(pass, blocks, segment, chain.count);
  }
  return {angular, linear};
}

/// Writes the next state in the active lanes only.
struct NextState {
  const Pass& pass;
  Mask active;

  void put(int row, V v) const {
    pass.set_state(row, hn::IfThenElse(active, without_negative_zero(v), pass.state(row)));
  }
  void put3(int row, V3 v) const {
    put(row, v.x);
    put(row + 1, v.y);
    put(row + 2, v.z);
  }
};

/// x ← x + (h v + e) with the error e of the sums before, which is kept exactly (two-sum; Knuth 1998,
/// sec. 4.2.2): steps of micrometres are added to metres.
HWY_INLINE void integrate_position(const NextState& next, int index, V velocity) {
  const V high = next.pass.state(StateRows::com + index);
  const V displacement =
      fma(set(next.pass.timestep_s()), velocity, next.pass.state(StateRows::com_compensation + index));
  const V sum = high + displacement;
  const V part = sum - high;
  next.put(StateRows::com + index, sum);
  next.put(StateRows::com_compensation + index, (high - (sum - part)) + (displacement - part));
}

/// q ← normalised q + (h/2) q (0, ω), ω in torso axes (rad/s): one Euler step of the quaternion's derivative
/// (Featherstone 2008, sec. 4.5; ODE's dxStepBody without finite rotation).
HWY_INLINE void integrate_rotation(const NextState& next, V3 angular_velocity) {
  const Pass& pass = next.pass;
  const V3 d = set(0.5f * pass.timestep_s()) * angular_velocity;
  const V w = pass.state(StateRows::rotation);
  const V3 q = pass.state3(StateRows::rotation + 1);
  const V w_next = fnma(q.z, d.z, fnma(q.y, d.y, fnma(q.x, d.x, w)));
  const V3 q_next = cross(q, d, fma(w, d, q));
  const V scale = set(1.0f) / hn::Sqrt(dot(q_next, q_next, w_next * w_next));
  next.put(StateRows::rotation, scale * w_next);
  next.put3(StateRows::rotation + 1, scale * q_next);
}

/// Squares of the joints' speeds. A sum is NaN as soon as one of its terms is; a maximum need not be.
struct JointSpeeds {
  V sum, largest;
};

/// Speeds of a chain's joints after the step by back substitution, L_cᵀ q̇ = u_c − B_cᵀ ν_b, and their angles,
/// q ← q + h q̇ (semi-implicit Euler). As the base's rows hold L_b⁻¹ B_c, B_cᵀ ν_b is their product with u_b.
/// Adds the squares of the speeds to `speeds`.
template <int N>
HWY_INLINE void integrate_joints(const NextState& next, std::size_t c, const V* u_base, JointSpeeds& speeds) {
  const Pass& pass = next.pass;
  const Chain& chain = pass.model().chains[c];
  const int n = length<N>(chain);
  const ChainFactor factor{pass.scratch(pass.work().factors[c]), n};
  V speed[capacity<N>];
  for (int j = n - 1; j >= 0; --j) {
    V x = load(pass.scratch(pass.work().u_joints + chain.first + j));
    for (int d = 0; d < 6; ++d) x = fnma(load(factor.base(j) + d * width), u_base[d], x);
    for (int i = j + 1; i < n; ++i) x = fnma(load(factor.lower(i, j)), speed[i], x);
    speed[j] = x * load(factor.inverse(j));
    const V square = speed[j] * speed[j];
    speeds.sum = speeds.sum + square;
    speeds.largest = max(speeds.largest, square);
    const int angle = pass.rows().angle + chain.first + j;
    next.put(angle, fma(set(pass.timestep_s()), speed[j], pass.state(angle)));
    next.put(pass.rows().speed + chain.first + j, speed[j]);
  }
}

/// Semi-implicit Euler: velocities from the solver's u and the external impulses, then positions with the new
/// velocities. Momentum: v_com += p / m + h g, L += Σ r × p. `u_base` becomes ν_b = L_b⁻ᵀ u_b.
template <int N>
HWY_NOINLINE void integrate(const Pass pass, const BaseFactor& factor, V* u_base) {
  const Model& model = pass.model();
  const NextState next{pass, pass.active()};
  const Spatial impulse = collect_impulses(pass);
  JointSpeeds speeds{zero(), zero()};
  for (std::size_t c = 0; c < model.chains.size(); ++c) integrate_joints<N>(next, c, u_base, speeds);
  solve_base_transposed(factor, u_base);
  const V3 angular_velocity{u_base[0], u_base[1], u_base[2]};

  const V3 velocity_change =
      fma(set(1.0f / model.mass_kg), impulse.linear, set(pass.timestep_s()) * set(model.gravity_m_s2));
  const V3 velocity = pass.state3(StateRows::velocity) + velocity_change;
  next.put3(StateRows::velocity, velocity);
  next.put3(StateRows::angular_momentum, pass.state3(StateRows::angular_momentum) + impulse.angular);
  integrate_position(next, 0, velocity.x);
  integrate_position(next, 1, velocity.y);
  integrate_position(next, 2, velocity.z);
  next.put3(StateRows::push_impulse, zero3());
  integrate_rotation(next, angular_velocity);

  constexpr auto fastest = static_cast<float>(absurd_speed);
  const V limit = set(fastest * fastest);
  Mask healthy = hn::And(dot(velocity, velocity) <= limit, dot(angular_velocity, angular_velocity) <= limit);
  healthy = hn::And(healthy, hn::And(speeds.largest <= limit, speeds.sum == speeds.sum));
  next.put(StateRows::healthy, hn::IfThenElseZero(healthy, pass.state(StateRows::healthy)));
}

/// Torques of the motors in the last step, τ = p / h + explicit torque (N m). A joint's row is the motor's
/// where its bounds are finite, and else its stop's.
HWY_NOINLINE void measure_torques(const Pass pass) {
  const V rate = set(1.0f / pass.timestep_s());
  for (const Chain& chain : pass.model().chains)
    for (int j = 0; j < chain.count; ++j) {
      const float* const row = pass.joint_row(chain, j);
      if (!pass.link(chain, j).has_motor) {
        hn::StoreU(zero(), Floats(), pass.arguments.torques_nm->row(pass.link(chain, j).joint) + pass.lane);
        continue;
      }
      const Mask motor =
          load(row + 2 * width) - load(row + width) < set(std::numeric_limits<float>::infinity());
      const V impulse =
          hn::IfThenElseZero(motor, pass.state(pass.rows().joint_impulse + chain.first_row + j));
      const V torque = fma(rate, impulse, load(row + 3 * width));
      hn::StoreU(torque, Floats(), pass.arguments.torques_nm->row(pass.link(chain, j).joint) + pass.lane);
    }
}

/// One step up to the new state; the numbers are those of docs/BATCH.md, "One step".
template <int N, Rows relaxed>
HWY_INLINE void step_chains(const Pass& pass, const LaneArray& targets_rad) {
  detect_contacts(pass);             // 1
  Base base = mass_matrix<N>(pass);  // 2
  bias_forces<N>(pass, base);        // 3
  BaseFactor factor;
  V u_base[6];
  unconstrained_velocity<N>(pass, targets_rad, base, factor, u_base);  // 4
  build_blocks<N, relaxed>(pass, factor, u_base);                      // 5
  if (std::isinf(pass.model().friction)) {
    solve<N, relaxed, Bound::sticking>(pass, u_base);
  } else {
    solve<N, relaxed, Bound::pyramid>(pass, u_base);
  }
  integrate<N>(pass, factor, u_base);  // 6
}

/// Robots whose chains all have three joints (most quadrupeds and hexapods) have code with fixed lengths.
void step_lanes(const StepArguments& arguments, const LaneArray& targets_rad) {
  const Model& model = arguments.model;
  const bool three_joints = model.equal_chains && model.longest_chain == 3;
  for (int lane = 0; lane < lanes; lane += width) {
    const Pass pass(arguments, lane);
    if (hn::AllFalse(Floats(), pass.active())) continue;
    if (three_joints && !model.joint_friction) {
      step_chains<3, Rows::together>(pass, targets_rad);
    } else if (three_joints) {
      step_chains<3, Rows::alone>(pass, targets_rad);
    } else {
      step_chains<-1, Rows::alone>(pass, targets_rad);
    }
    if (arguments.torques_nm != nullptr) measure_torques(pass);
    forward_kinematics(pass);
    read_sensors(pass);
  }
}

void derive_lanes(const StepArguments& arguments) {
  for (int lane = 0; lane < lanes; lane += width) {
    const Pass pass(arguments, lane);
    forward_kinematics(pass);
    detect_contacts(pass);
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

void step(const StepArguments& arguments, const LaneArray& targets_rad) {
  const DenormalsAreZero guard;
  HWY_DYNAMIC_DISPATCH(step_lanes)(arguments, targets_rad);
}

void derive(const StepArguments& arguments) {
  const DenormalsAreZero guard;
  HWY_DYNAMIC_DISPATCH(derive_lanes)(arguments);
}

void sine_cosine(const float* angles_rad, float* sines, float* cosines, int count) {
  HWY_DYNAMIC_DISPATCH(sine_cosine_array)(angles_rad, sines, cosines, count);
}

void arc_tangent(const float* y, const float* x, float* angles_rad, int count) {
  HWY_DYNAMIC_DISPATCH(arc_tangent_array)(y, x, angles_rad, count);
}

}  // namespace amble::physics::batch
#endif
