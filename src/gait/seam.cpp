#include "amble/gait/seam.hpp"

#include <algorithm>
#include <cmath>

#include "amble/core/index.hpp"

namespace amble::gait {

SeamMeter::SeamMeter(const robot::RobotSpec& robot, double frame_s)
    : frame_s_(frame_s),
      frames_after_(static_cast<int>(std::lround(0.1 / frame_s))),
      left_(robot.legs.size()) {
  for (const robot::Leg& leg : robot.legs) {
    auto& joints = joints_of_leg_.emplace_back();
    for (const int joint : leg.joints)
      if (joint >= 0) joints.push_back(to_index(joint));
  }
}

void SeamMeter::add(const Frame& frame) {
  with_torques_ = with_torques_ && !frame.torque_nm.empty();
  if (!timer_.empty())
    for (std::size_t leg = 0; leg < joints_of_leg_.size(); ++leg) add_leg(leg, frame);
  target_rad_.assign(frame.target_rad.begin(), frame.target_rad.end());
  angle_rad_.assign(frame.angle_rad.begin(), frame.angle_rad.end());
  timer_.assign(frame.timer.begin(), frame.timer.end());
}

bool SeamMeter::jumped(std::size_t leg, const Frame& frame) const {
  const float before = timer_[leg], now = frame.timer[leg];
  return frame.trigger[leg] > 0.5f || now < before || (before < 0.0f && now >= 0.0f);
}

void SeamMeter::add_leg(std::size_t leg, const Frame& frame) {
  if (jumped(leg, frame)) {
    double farthest_rad = 0.0;
    for (const std::size_t joint : joints_of_leg_[leg])
      farthest_rad =
          std::max(farthest_rad, std::abs(static_cast<double>(frame.target_rad[joint]) - target_rad_[joint]));
    ++jumps_;
    sum_rad_ += farthest_rad;
    largest_rad_ = std::max(largest_rad_, farthest_rad);
    left_[leg] = frames_after_;
  }
  if (left_[leg] == 0 || !with_torques_) return;
  --left_[leg];
  ++power_frames_;
  for (const std::size_t joint : joints_of_leg_[leg]) {
    const double turned_rad = static_cast<double>(frame.angle_rad[joint]) - angle_rad_[joint];
    power_sum_w_ += std::abs(static_cast<double>(frame.torque_nm[joint]) * turned_rad) / frame_s_;
  }
}

SeamReport SeamMeter::report() const {
  SeamReport report{.jumps = jumps_, .mean_rad = 0.0, .largest_rad = largest_rad_, .power_after_w = {}};
  if (jumps_ > 0) report.mean_rad = sum_rad_ / static_cast<double>(jumps_);
  if (with_torques_ && power_frames_ > 0)
    report.power_after_w = power_sum_w_ / static_cast<double>(power_frames_);
  return report;
}

}  // namespace amble::gait
