// Forces that do not come from the constraint solver: bias forces and servos; for each instruction set.
#if defined(AMBLE_BATCH_FORCES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef AMBLE_BATCH_FORCES_INL_HPP
#undef AMBLE_BATCH_FORCES_INL_HPP
#else
#define AMBLE_BATCH_FORCES_INL_HPP
#endif

#include <limits>

#include "amble/physics/batch/inertia-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace amble::physics::batch::HWY_NAMESPACE {

/// Force on a body of this inertia that moves with `velocity` and `acceleration`, f = I a + v ×* I v (Newton
/// and Euler; Featherstone 2008, sec. 2.14).
HWY_INLINE Spatial inertial_force(const Symmetric& inertia, V3 first_moment, V mass, const Spatial& velocity,
                                  const Spatial& acceleration) {
  const Spatial momentum{cross(first_moment, velocity.linear, inertia * velocity.angular),
                         cross(velocity.angular, first_moment, mass * velocity.linear)};
  const V3 torque = cross(first_moment, acceleration.linear, inertia * acceleration.angular);
  const V3 force = cross(acceleration.angular, first_moment, mass * acceleration.linear);
  // (ω, v) ×* (n, f) = (ω × n + v × f, ω × f).
  return {cross(velocity.angular, momentum.angular, cross(velocity.linear, momentum.linear, torque)),
          cross(velocity.angular, momentum.linear, force)};
}

/// Recursive Newton–Euler algorithm for one chain with q̈ = 0, the base unaccelerated and no gravity
/// (Featherstone 2008, sec. 5.3). Outwards v_j = v_p + S_j q̇_j and a_j = a_p + v_p × S_j q̇_j; inwards
/// f_j = I_j a_j + v_j ×* I_j v_j + f_(j+1). Writes the joints' bias forces C_j = S_jᵀ f_j (N m) and adds the
/// force that the chain transmits to the base to `total`.
template <int N>
HWY_INLINE void chain_bias_forces(const Pass& pass, const Chain& chain, const Base& base, V* forces,
                                  Spatial& total) {
  const int n = length<N>(chain);
  Spatial link_force[capacity<N>];
  Spatial velocity = base.velocity, acceleration = zero_spatial();
  for (int j = 0; j < n; ++j) {
    const Link& link = pass.link(chain, j);
    const Spatial subspace = motion_subspace(pass, chain, j);
    const V speed = pass.state(pass.rows().speed + chain.first + j);
    // v × S = (ω × a, ω × (c × a) + v × a).
    const Spatial subspace_rate{
        cross(velocity.angular, subspace.angular),
        cross(velocity.angular, subspace.linear, cross(velocity.linear, subspace.angular))};
    acceleration = fma(speed, subspace_rate, acceleration);
    velocity = fma(speed, subspace, velocity);
    link_force[j] = zero_spatial();
    if (link.has_mass) {
      const float* own = pass.scratch(pass.work().link_inertia + 9 * (chain.first + j));
      link_force[j] = inertial_force(load_inertia(own), load_first_moment(own), set(link.body.mass_kg),
                                     velocity, acceleration);
    }
  }
  Spatial transmitted = zero_spatial();
  for (int j = n - 1; j >= 0; --j) {
    transmitted = transmitted + link_force[j];
    forces[j] = dot(motion_subspace(pass, chain, j), transmitted);
  }
  total = total + transmitted;
}

/// Bias forces of all joints, kept in place of u_joints until unconstrained_chain(), and the bias
/// acceleration of the base.
template <int N>
HWY_NOINLINE void bias_forces(const Pass& pass, Base& base) {
  const Model& model = pass.model();
  Spatial total = inertial_force(base.torso_inertia, base.torso_first_moment, set(model.torso.mass_kg),
                                 base.velocity, zero_spatial());
  for (const Chain& chain : model.chains) {
    V forces[capacity<N> > 0 ? capacity<N> : 1];
    chain_bias_forces<N>(pass, chain, base, forces, total);
    for (int j = 0; j < length<N>(chain); ++j)
      store(forces[j], pass.scratch(pass.work().u_joints + chain.first + j));
  }
  // Momentum is the state and constant without external forces, so with q̈ = 0 the base accelerates by
  // −M_bb⁻¹ C_b, C_b being the bias force of the whole robot.
  base.bias_acceleration.angular = zero3() - base.inverse_inertia * total.angular;
  base.bias_acceleration.linear = set(-1.0f / model.mass_kg) * total.linear;
}

/// Target velocity (rad/s) and bounds of the impulse (N m s) of a joint's constraint row.
HWY_INLINE void store_joint_row(float* row, V target, V low, V high) {
  store(target, row);
  store(low, row + width);
  store(high, row + 2 * width);
}

/// The row of a joint's stop, q̇⁺ = −(erp/h) (q − q_stop) by an impulse towards the range only. Lanes within
/// the range have bounds of 0.
struct StopRow {
  Mask at_upper, stopped;
  V target, low, high;
};

HWY_INLINE StopRow stop_row(const Pass& pass, const Link& link, V angle) {
  const V lower = set(link.lower_rad), upper = set(link.upper_rad);
  const V infinite = set(std::numeric_limits<float>::infinity());
  const float correction = -pass.model().erp / pass.timestep_s();
  const Mask at_lower = angle <= lower, at_upper = hn::AndNot(at_lower, angle >= upper);
  const V beyond = hn::IfThenElse(at_lower, angle - lower, angle - upper);
  return {.at_upper = at_upper,
          .stopped = hn::Or(at_lower, at_upper),
          .target = set(correction) * beyond,
          .low = hn::IfThenElseZero(at_upper, hn::Neg(infinite)),
          .high = hn::IfThenElseZero(at_lower, infinite)};
}

/// Writes the constraint row that a joint's motor and stops share, and returns the explicit torque of its
/// servo (N m), both as in ODE (dxJointLimitMotor::addLimot). At a stop the row is the stop's, and a motor
/// becomes a torque of its full strength towards its target. A target that is NaN becomes a torque that is
/// NaN, so that the robot counts as diverged.
HWY_INLINE V apply_servo(const Pass& pass, const LaneArray& targets_rad, const Link& link, int index) {
  const V angle = pass.state(pass.rows().angle + index), speed = pass.state(pass.rows().speed + index);
  const V lower = set(link.lower_rad), upper = set(link.upper_rad), none = zero();
  const V command = hn::LoadU(Floats(), targets_rad.row(link.joint) + pass.lane);
  const V target = hn::IfThenElse(command == command, hn::Min(hn::Max(command, lower), upper), command);
  const V max_torque = set(link.max_torque_nm);
  const StopRow stop = stop_row(pass, link, angle);
  float* const row = pass.scratch(pass.work().joint_row + 4 * index);
  if (!link.velocity_servo) {
    // τ = kp (target − q) − kd q̇, within ± max_torque.
    store_joint_row(row, stop.target, stop.low, stop.high);
    const V torque = fnma(set(link.kd_nm_s_per_rad), speed, set(link.kp_nm_per_rad) * (target - angle));
    return hn::IfThenElse(torque == torque, hn::Min(hn::Max(torque, hn::Neg(max_torque)), max_torque),
                          torque);
  }
  // Motor: q̇⁺ = gain (target − q), by an impulse within ± max_torque h.
  const V motor_speed = set(link.gain_per_s) * (target - angle);
  const V impulse = set(link.max_torque_nm * pass.timestep_s());
  store_joint_row(row, hn::IfThenElse(stop.stopped, stop.target, motor_speed),
                  hn::IfThenElse(stop.stopped, stop.low, hn::Neg(impulse)),
                  hn::IfThenElse(stop.stopped, stop.high, impulse));
  const Mask forward = hn::Or(motor_speed > none, hn::And(motor_speed == none, stop.at_upper));
  const V torque = hn::IfThenElseZero(stop.stopped, hn::IfThenElse(forward, max_torque, hn::Neg(max_torque)));
  return hn::IfThenElse(command == command, torque, command);
}

}  // namespace amble::physics::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggled by HWY_TARGET_TOGGLE
