// What moves the joints without the solver's doing: inertial forces and servos; for each instruction set.
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

/// Force that keeps a body of this inertia on its way, while it moves by `motion` and is accelerated by
/// `rate` (Newton and Euler; Featherstone 2008, eq. 2.63).
HWY_INLINE Spatial inertial_force(const Symmetric& second, V3 first, V mass, const Spatial& motion,
                                  const Spatial& rate) {
  const Spatial momentum{cross(first, motion.push, second * motion.turn),
                         cross(motion.turn, first, mass * motion.push)};
  const V3 turn = cross(first, rate.push, second * rate.turn);
  const V3 push = cross(rate.turn, first, mass * rate.push);
  return {cross(motion.turn, momentum.turn, cross(motion.push, momentum.push, turn)),
          cross(motion.turn, momentum.push, push)};
}

/// The joints' inertial forces while no joint is accelerated and the base's acceleration is zero (recursive
/// Newton–Euler algorithm, Featherstone 2008, sec. 5.3); their share of the base's is added to `total`.
template <int N>
HWY_INLINE void inertial_forces(const Pass& pass, const Chain& chain, const Base& base, V* forces,
                                Spatial& total) {
  const int n = length<N>(chain);
  Spatial on_link[capacity<N>];
  Spatial motion = base.motion, rate = no_spatial();
  for (int j = 0; j < n; ++j) {
    const Link& link = pass.link(chain, j);
    const Spatial axis = joint_motion(pass, chain, j);
    const V speed = pass.state(pass.batch.rows.speed + chain.first + j);
    const Spatial swept{cross(motion.turn, axis.turn),
                        cross(motion.turn, axis.push, cross(motion.push, axis.turn))};
    rate = fma(speed, swept, rate);
    motion = fma(speed, axis, motion);
    on_link[j] = no_spatial();
    if (link.has_mass) {
      const float* own = pass.scratch(pass.work().inertia + 9 * (chain.first + j));
      on_link[j] = inertial_force(load_second(own), load_first(own), set(link.body.mass_kg), motion, rate);
    }
  }
  Spatial carried = no_spatial();
  for (int j = n - 1; j >= 0; --j) {
    carried = carried + on_link[j];
    forces[j] = dot(joint_motion(pass, chain, j), carried);
  }
  total = total + carried;
}

/// All inertial forces, kept as rows `free`, and the drift of the base.
template <int N>
HWY_NOINLINE void find_inertial_forces(const Pass& pass, Base& base) {
  const Model& model = pass.model();
  Spatial total = inertial_force(base.torso_second, base.torso_first, set(model.torso.mass_kg), base.motion,
                                 no_spatial());
  for (const Chain& chain : model.chains) {
    V forces[capacity<N> > 0 ? capacity<N> : 1];
    inertial_forces<N>(pass, chain, base, forces, total);
    for (int j = 0; j < length<N>(chain); ++j)
      store(forces[j], pass.scratch(pass.work().free + chain.first + j));
  }
  // The momentum is the state and does not drift, so the base must, where the joints go on unaccelerated.
  base.drift.turn = zero3() - base.inverse * total.turn;
  base.drift.push = set(-1.0f / model.mass_kg) * total.push;
}

HWY_INLINE void bound(float* servo, V speed, V low, V high) {
  store(speed, servo);
  store(low, servo + width);
  store(high, servo + 2 * width);
}

/// Torque of the servo, and the row that motor or stop add to the solver, as ODE has them
/// (dxJointLimitMotor): one row for both. At a stop a motor becomes a torque of its full strength, towards
/// where it wants to go. A target that is not a number becomes such a torque, and the robot diverges.
HWY_INLINE V drive(const Pass& pass, const LaneArray& targets_rad, const Link& link, int index) {
  const V angle = pass.state(pass.batch.rows.angle + index),
          speed = pass.state(pass.batch.rows.speed + index);
  const V lower = set(link.lower_rad), upper = set(link.upper_rad), none = zero();
  const V asked = hn::LoadU(Floats(), targets_rad.row(link.joint) + pass.lane);
  const V target = hn::IfThenElse(asked == asked, hn::Min(hn::Max(asked, lower), upper), asked);
  const V most = set(link.max_torque_nm);
  const Mask at_lower = angle <= lower, at_upper = hn::AndNot(at_lower, angle >= upper);
  const Mask stopped = hn::Or(at_lower, at_upper);
  const V infinite = set(std::numeric_limits<float>::infinity());
  const float pull = -pass.model().erp / pass.batch.timestep_s;
  const V beyond = hn::IfThenElse(at_lower, angle - lower, angle - upper);
  const V low = hn::IfThenElseZero(at_upper, hn::Neg(infinite)),
          high = hn::IfThenElseZero(at_lower, infinite);
  float* const row = pass.scratch(pass.work().servos + 4 * index);
  if (!link.velocity_servo) {
    bound(row, set(pull) * beyond, low, high);
    const V torque = fnma(set(link.kd_nm_s_per_rad), speed, set(link.kp_nm_per_rad) * (target - angle));
    return hn::IfThenElse(torque == torque, hn::Min(hn::Max(torque, hn::Neg(most)), most), torque);
  }
  const V wanted = set(link.gain_per_s) * (target - angle);
  const V impulse = set(link.max_torque_nm * pass.batch.timestep_s);
  bound(row, hn::IfThenElse(stopped, set(pull) * beyond, wanted),
        hn::IfThenElse(stopped, low, hn::Neg(impulse)), hn::IfThenElse(stopped, high, impulse));
  const Mask upwards = hn::Or(wanted > none, hn::And(wanted == none, at_upper));
  const V torque = hn::IfThenElseZero(stopped, hn::IfThenElse(upwards, most, hn::Neg(most)));
  return hn::IfThenElse(asked == asked, torque, asked);
}

}  // namespace amble::physics::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggled by HWY_TARGET_TOGGLE
