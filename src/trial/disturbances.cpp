#include "amble/trial/disturbances.hpp"

#include <utility>

namespace amble::trial {
namespace {

/// Added to a number, leaves it as it is to the bit; +0 would turn −0 into +0.
constexpr float nothing = -0.0f;

/// Adds `offset` to `values`. Row by row over the lanes, so that the compiler makes it a few SIMD
/// instructions.
void add(const LaneArray& offset, LaneArray& values) {
  for (int r = 0; r < values.rows(); ++r) {
    const float* const from = offset.row(r);
    float* const to = values.row(r);
    for (int lane = 0; lane < values.lanes(); ++lane) to[lane] += from[lane];
  }
}

}  // namespace

Disturbances::Disturbances(const robot::SensorFrame& sensors)
    : lanes_(static_cast<std::size_t>(sensors.touch.lanes())),
      joint_offset_rad_(sensors.joint_angle_rad.rows(), sensors.touch.lanes()),
      attitude_offset_rad_(sensors.attitude_rad.rows(), sensors.touch.lanes()) {
  for (int lane = 0; lane < sensors.touch.lanes(); ++lane) load(lane, nullptr);
}

void Disturbances::load(int lane, const Scenario* scenario) {
  Lane& slot = lanes_[static_cast<std::size_t>(lane)];
  disturbed_ += (scenario != nullptr) - (slot.scenario != nullptr);
  slot.scenario = scenario;
  slot.step = 0;
  slot.next_push = slot.next_flip = 0;
  slot.late_rad.clear();
  for (int j = 0; j < joint_offset_rad_.rows(); ++j)
    joint_offset_rad_.at(j, lane) =
        scenario ? scenario->joint_sensor_rad[static_cast<std::size_t>(j)] : nothing;
  for (int a = 0; a < attitude_offset_rad_.rows(); ++a)
    attitude_offset_rad_.at(a, lane) =
        scenario ? scenario->attitude_sensor_rad[static_cast<std::size_t>(a)] : nothing;
}

const robot::SensorFrame& Disturbances::read(const robot::SensorFrame& sensors) {
  if (disturbed_ == 0) return sensors;
  read_ = sensors;
  add(joint_offset_rad_, read_.joint_angle_rad);
  add(attitude_offset_rad_, read_.attitude_rad);
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    if (lanes_[i].scenario == nullptr) continue;
    ++lanes_[i].step;
    flip_touches(lanes_[i], static_cast<int>(i));
  }
  return read_;
}

void Disturbances::flip_touches(Lane& lane, int index) {
  const auto& flips = lane.scenario->touch_flips;
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
