#include "amble/experiment/gait_observer.hpp"

#include "amble/robot/pose.hpp"
#include "amble/trial/observers.hpp"

namespace amble::experiment {
namespace {

void copy_lane(const LaneArray& rows, int lane, std::vector<float>& values) {
  values.clear();
  for (int row = 0; row < rows.rows(); ++row) values.push_back(rows.at(row, lane));
}

/// The body that is measured: as it begins, with its damage.
gait::Body body_in(const Problem& problem) {
  gait::Body body = gait::body_of(problem.robot);
  if (problem.damage.changes_body()) body.mass_kg = problem.mass_kg();
  return body;
}

}  // namespace

GaitObserver::GaitObserver(const Problem& problem, const gait::Settings& settings)
    : body_(body_in(problem)),
      timestep_s_(problem.trial.timestep_s),
      settings_(settings),
      meter_(body_, timestep_s_, settings_),
      seam_(problem.robot, timestep_s_),
      legs_(problem.robot.legs.size()) {}

void GaitObserver::on_start(const physics::Engine& engine, int lane) {
  const Vec3 com_m = engine.com_m(lane);
  const bool elsewhere = robot::starts_elsewhere(com_m, body_.com_start_m);
  body_.angle_start_rad = trial::bent_start(engine.sensors().joint_angle_rad, lane);
  if (!elsewhere && body_.angle_start_rad.empty()) return;
  if (elsewhere) body_.com_start_m = com_m;
  meter_ = gait::Meter(body_, timestep_s_, settings_);
}

void GaitObserver::on_step(int, const physics::Engine& engine, const controllers::Batch& controllers,
                           const LaneArray& targets_rad, int lane) {
  copy_lane(engine.sensors().touch, lane, touch_);
  copy_lane(engine.sensors().joint_angle_rad, lane, angle_rad_);
  if (const LaneArray* torques_nm = engine.motor_torque_nm()) copy_lane(*torques_nm, lane, torque_nm_);
  meter_.add(
      {.com_m = engine.com_m(lane), .touch = touch_, .angle_rad = angle_rad_, .torque_nm = torque_nm_});
  add_seam(controllers, targets_rad, lane);
}

/// Only for controllers whose state begins with a timer and then a trigger per leg, as recordings name them.
void GaitObserver::add_seam(const controllers::Batch& controllers, const LaneArray& targets_rad, int lane) {
  if (state_.empty()) {
    const std::vector<std::string> names = controllers.state_names();
    state_.resize(names.size());
    timers_ = legs_ > 0 && names.size() >= 2 * legs_ && names[0].starts_with("timer.") &&
              names[legs_].starts_with("trigger.");
  }
  if (!timers_) return;
  controllers.state(lane, state_);
  copy_lane(targets_rad, lane, target_rad_);
  const std::span<const float> state = state_;
  seam_.add({.target_rad = target_rad_,
             .angle_rad = angle_rad_,
             .torque_nm = torque_nm_,
             .timer = state.first(legs_),
             .trigger = state.subspan(legs_, legs_)});
}

gait::Report GaitObserver::finish(record::Outcome outcome) {
  gait::Report report = meter_.finish(outcome);
  if (timers_) report.seam = seam_.report();
  return report;
}

}  // namespace amble::experiment
