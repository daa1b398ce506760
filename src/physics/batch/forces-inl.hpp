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
/// f_j = I_j a_j + v_j ×* I_j v_j + Σ f_child. Writes the joints' bias forces C_j = S_jᵀ f_j + damping q̇_j
/// (N m) and adds the force that the chain transmits to the base to `total`.
template <int N>
HWY_INLINE void chain_bias_forces(const Pass& pass, const Chain& chain, const Base& base, V* forces,
                                  Spatial& total) {
  const int n = length<N>(chain);
  Spatial link_force[capacity<N>], link_velocity[capacity<N>], link_acceleration[capacity<N>];
  for (int j = 0; j < n; ++j) {
    const Link& link = pass.link(chain, j);
    const int parent = parent_of<N>(link, j);
    const Spatial subspace = motion_subspace(pass, chain, j);
    const V speed = pass.state(pass.rows().speed + chain.first + j);
    const Spatial before = parent < 0 ? base.velocity : link_velocity[parent];
    // v × S = (ω × a, ω × (c × a) + v × a).
    const Spatial subspace_rate{
        cross(before.angular, subspace.angular),
        cross(before.angular, subspace.linear, cross(before.linear, subspace.angular))};
    link_acceleration[j] = fma(speed, subspace_rate, parent < 0 ? zero_spatial() : link_acceleration[parent]);
    link_velocity[j] = fma(speed, subspace, before);
    link_force[j] = zero_spatial();
    if (link.has_mass) {
      const float* own = pass.scratch(pass.work().link_inertia + 9 * (chain.first + j));
      link_force[j] = inertial_force(load_inertia(own), load_first_moment(own), set(link.body.mass_kg),
                                     link_velocity[j], link_acceleration[j]);
    }
  }
  for (int j = n - 1; j >= 0; --j) {
    const Link& link = pass.link(chain, j);
    const int parent = parent_of<N>(link, j);
    forces[j] = dot(motion_subspace(pass, chain, j), link_force[j]);
    if (link.damping_nm_s_per_rad != 0.0f)
      forces[j] =
          fma(set(link.damping_nm_s_per_rad), pass.state(pass.rows().speed + chain.first + j), forces[j]);
    Spatial& outer = parent < 0 ? total : link_force[parent];
    outer = outer + link_force[j];
  }
}

/// Bias forces of all joints, kept in place of u_joints until unconstrained_chain(), and the bias
/// acceleration of the base.
template <int N>
HWY_NOINLINE void bias_forces(const Pass pass, Base& base) {
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

/// Target velocity (rad/s), bounds of the impulse (N m s) and softness of a joint's constraint row.
HWY_INLINE void store_joint_row(float* row, V target, V low, V high, V softness) {
  store(target, row);
  store(low, row + width);
  store(high, row + 2 * width);
  store(softness, row + 4 * width);
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

/// What a servo aims at: its row is q̇⁺ + softness p = speed, |p| ≤ max_impulse.
struct ServoRow {
  V speed;            ///< rad/s
  float max_impulse;  ///< N m s
  float softness;     ///< velocity per impulse, rad/s per N m s
  V torque_at_stop;   ///< N m
};

/// Velocity servo: speed gain (target − q), as soft as all of ODE's rows. Torque servo, with the angle and
/// speed at the end of the step (backward Euler), so that it is stable however stiff it is:
///   τ = kp (target − q − h q̇⁺) − kd q̇⁺ = k (speed − q̇⁺),   k = kp h + kd,   speed = kp (target − q) / k.
HWY_INLINE ServoRow servo_row(const Pass& pass, const Link& link, V error, Mask at_upper) {
  const float h = pass.timestep_s();
  const V max_torque = set(link.max_torque_nm), none = zero();
  if (link.velocity_servo) {
    // ODE's motor pushes with full strength while its joint is at a stop (dxJointLimitMotor::addLimot).
    const V speed = set(link.gain_per_s) * error;
    const Mask forward = hn::Or(speed > none, hn::And(speed == none, at_upper));
    return {speed, link.max_torque_nm * h, pass.model().cfm_s_per_kg / h,
            hn::IfThenElse(forward, max_torque, hn::Neg(max_torque))};
  }
  const float k = link.kp_nm_per_rad * h + link.kd_nm_s_per_rad;
  if (k == 0.0f) return {none, 0.0f, 0.0f, none};
  const V torque = set(link.kp_nm_per_rad) * error;
  return {set(link.kp_nm_per_rad / k) * error, link.max_torque_nm * h, 1.0f / (k * h),
          min(max(torque, hn::Neg(max_torque)), max_torque)};
}

/// Writes the constraint row that a joint's motor and stops share, and returns the explicit torque of its
/// servo (N m). At a stop the row is the stop's, and the servo becomes an explicit torque towards its target,
/// as in ODE. A target that is NaN becomes a torque that is NaN, so that the robot counts as diverged.
HWY_INLINE V apply_servo(const Pass& pass, const LaneArray& targets_rad, const Link& link, int index,
                         float* row) {
  const V angle = pass.state(pass.rows().angle + index);
  const V lower = set(link.lower_rad), upper = set(link.upper_rad);
  const V command =
      link.has_motor ? hn::LoadU(Floats(), targets_rad.row(link.joint) + pass.lane) : set(link.rest_rad);
  const V within = hn::IfThenElse(command == command, min(max(command, lower), upper), command);
  const V target = link.has_motor ? within : command;
  const StopRow stop = stop_row(pass, link, angle);
  const ServoRow servo = servo_row(pass, link, target - angle, stop.at_upper);
  const V impulse = set(servo.max_impulse), stiff = set(pass.model().cfm_s_per_kg / pass.timestep_s());
  store_joint_row(row, hn::IfThenElse(stop.stopped, stop.target, servo.speed),
                  hn::IfThenElse(stop.stopped, stop.low, hn::Neg(impulse)),
                  hn::IfThenElse(stop.stopped, stop.high, impulse),
                  hn::IfThenElse(stop.stopped, stiff, set(servo.softness)));
  return hn::IfThenElse(command == command, hn::IfThenElseZero(stop.stopped, servo.torque_at_stop), command);
}

/// The row of a joint's dry friction, q̇⁺ = 0 by an impulse within ± friction_loss h.
HWY_INLINE void apply_friction(const Pass& pass, const Link& link, float* row) {
  const V impulse = set(link.friction_loss_nm * pass.timestep_s());
  store_joint_row(row, zero(), hn::Neg(impulse), impulse, set(pass.model().cfm_s_per_kg / pass.timestep_s()));
  store(zero(), row + 3 * width);
}

}  // namespace amble::physics::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggled by HWY_TARGET_TOGGLE
