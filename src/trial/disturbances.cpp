#include "amble/trial/disturbances.hpp"

#include <utility>

namespace amble::trial {

Disturbances::Disturbances(const physics::SensorFrame& sensors)
    : lanes_(static_cast<std::size_t>(sensors.touch.lanes())) {}

void Disturbances::load(int lane, const Scenario* scenario) {
  Lane& slot = lanes_[static_cast<std::size_t>(lane)];
  disturbed_ += (scenario != nullptr) - (slot.scenario != nullptr);
  slot.scenario = scenario;
  slot.step = 0;
  slot.next_push = slot.next_flip = 0;
  slot.late_rad.clear();
}

const physics::SensorFrame& Disturbances::read(const physics::SensorFrame& sensors) {
  if (disturbed_ == 0) return sensors;
  read_ = sensors;
  for (std::size_t i = 0; i < lanes_.size(); ++i)
    if (lanes_[i].scenario != nullptr) disturb_sensors(lanes_[i], static_cast<int>(i));
  return read_;
}

void Disturbances::disturb_sensors(Lane& lane, int index) {
  const Scenario& scenario = *lane.scenario;
  ++lane.step;
  for (int j = 0; j < read_.joint_angle_rad.rows(); ++j)
    read_.joint_angle_rad.at(j, index) += scenario.joint_sensor_rad[static_cast<std::size_t>(j)];
  for (int a = 0; a < read_.attitude_rad.rows(); ++a)
    read_.attitude_rad.at(a, index) += scenario.attitude_sensor_rad[static_cast<std::size_t>(a)];

  const auto& flips = scenario.touch_flips;
  for (; lane.next_flip < flips.size() && flips[lane.next_flip].step == lane.step; ++lane.next_flip) {
    float& touch = read_.touch.at(flips[lane.next_flip].leg, index);
    touch = 1.0f - touch;
  }
}

void Disturbances::act(LaneArray& targets_rad, physics::Engine& engine) {
  if (disturbed_ == 0) return;
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    Lane& lane = lanes_[i];
    if (lane.scenario == nullptr) continue;
    const int index = static_cast<int>(i);
    if (lane.scenario->latency_ticks > 0) delay(lane, index, targets_rad);
    const auto& pushes = lane.scenario->pushes;
    for (; lane.next_push < pushes.size() && pushes[lane.next_push].step == lane.step; ++lane.next_push)
      engine.push(index, pushes[lane.next_push].impulse_n_s);
  }
}

/// Swaps the targets of this tick for those of `latency` ticks ago, which stand where they belong in the
/// ring.
void Disturbances::delay(Lane& lane, int index, LaneArray& targets_rad) {
  const auto latency = static_cast<std::size_t>(lane.scenario->latency_ticks);
  const auto joints = static_cast<std::size_t>(targets_rad.rows());
  lane.late_rad.resize(latency * joints);  // zeros at first
  float* const late_rad = lane.late_rad.data() + static_cast<std::size_t>(lane.step) % latency * joints;
  for (std::size_t j = 0; j < joints; ++j) std::swap(targets_rad.at(static_cast<int>(j), index), late_rad[j]);
}

}  // namespace amble::trial
