#include "amble/experiment/gait_observer.hpp"

namespace amble::experiment {
namespace {

void copy_lane(const LaneArray& rows, int lane, std::vector<float>& values) {
  values.clear();
  for (int row = 0; row < rows.rows(); ++row) values.push_back(rows.at(row, lane));
}

}  // namespace

GaitObserver::GaitObserver(const robot::RobotSpec& robot, double timestep_s, const gait::Settings& settings)
    : meter_(gait::body_of(robot), timestep_s, settings),
      seam_(robot, timestep_s),
      legs_(robot.legs.size()) {}

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
