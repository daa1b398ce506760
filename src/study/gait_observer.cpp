#include "amble/study/gait_observer.hpp"

namespace amble::study {
namespace {

void copy_lane(const LaneArray& rows, int lane, std::vector<float>& values) {
  values.clear();
  for (int row = 0; row < rows.rows(); ++row) values.push_back(rows.at(row, lane));
}

}  // namespace

GaitObserver::GaitObserver(const robot::RobotSpec& robot, double timestep_s, const gait::Settings& settings)
    : meter_(gait::body_of(robot), timestep_s, settings) {}

void GaitObserver::on_step(int, const physics::Engine& engine, const controllers::Batch&, const LaneArray&,
                           int lane) {
  copy_lane(engine.sensors().touch, lane, touch_);
  copy_lane(engine.sensors().joint_angle_rad, lane, angle_rad_);
  if (const LaneArray* torques_nm = engine.motor_torque_nm()) copy_lane(*torques_nm, lane, torque_nm_);
  meter_.add(
      {.com_m = engine.com_m(lane), .touch = touch_, .angle_rad = angle_rad_, .torque_nm = torque_nm_});
}

}  // namespace amble::study
