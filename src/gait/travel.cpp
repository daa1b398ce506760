#include "amble/gait/travel.hpp"

#include <algorithm>
#include <cmath>

#include "amble/core/check.hpp"

namespace amble::gait {
namespace {

double over_ground_m(Vec3 from, Vec3 to) {
  return std::hypot(to.x - from.x, to.y - from.y);
}

}  // namespace

TravelMeter::TravelMeter(Vec3 com_start_m, std::span<const float> angle_start_rad, double frame_s)
    : frames_per_leg_of_path_(std::max<std::int64_t>(1, std::llround(1.0 / frame_s))),
      start_m_(com_start_m),
      path_point_m_(com_start_m),
      com_m_(com_start_m),
      angle_rad_(angle_start_rad.begin(), angle_start_rad.end()),
      turned_rad_(angle_start_rad.size()) {}

void TravelMeter::add(Vec3 com_m, std::span<const float> angle_rad, std::span<const float> torque_nm) {
  com_m_ = com_m;
  if (++frames_ % frames_per_leg_of_path_ == 0) {
    path_m_ += over_ground_m(path_point_m_, com_m);
    path_point_m_ = com_m;
  }
  if (torque_nm.empty()) {
    torques_known_ = false;
  } else {
    add_work(angle_rad, torque_nm);
  }
}

void TravelMeter::add_work(std::span<const float> angle_rad, std::span<const float> torque_nm) {
  AMBLE_CHECK(angle_rad.size() == angle_rad_.size() && torque_nm.size() == angle_rad_.size(),
              "one angle and torque per joint");
  for (std::size_t j = 0; j < angle_rad_.size(); ++j) {
    // The work of a torque is that at the mean of the speeds before and after the step. Engines integrate
    // velocities first and positions then, so a joint turns by its speed after the step.
    const double turned_rad = static_cast<double>(angle_rad[j]) - angle_rad_[j];
    const double work_j = static_cast<double>(torque_nm[j]) * 0.5 * (turned_rad_[j] + turned_rad);
    work_.positive_j += std::max(work_j, 0.0);
    work_.absolute_j += std::abs(work_j);
    angle_rad_[j] = static_cast<double>(angle_rad[j]);
    turned_rad_[j] = turned_rad;
  }
}

double TravelMeter::distance_m() const {
  return over_ground_m(start_m_, com_m_);
}

double TravelMeter::path_m() const {
  return path_m_ + over_ground_m(path_point_m_, com_m_);
}

std::optional<MotorWork> TravelMeter::work() const {
  if (!torques_known_ || frames_ == 0 || angle_rad_.empty()) return std::nullopt;
  return work_;
}

}  // namespace amble::gait
