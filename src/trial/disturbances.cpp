#include "amble/trial/disturbances.hpp"

#include <utility>

#include "amble/core/index.hpp"

namespace amble::trial {
namespace {

/// Leaves any number that it is added to unchanged to the bit; +0 would turn −0 into +0.
constexpr float no_offset = -0.0f;

/// Adds `offset` to `values`, row by row over the lanes, which the compiler vectorises.
void add(const LaneArray& offset, LaneArray& values) {
  for (int r = 0; r < values.rows(); ++r) {
    const float* const from = offset.row(r);
    float* const to = values.row(r);
    for (int lane = 0; lane < values.lanes(); ++lane) to[lane] += from[lane];
  }
}

}  // namespace

Disturbances::Disturbances(const robot::SensorFrame& sensors, std::vector<NumbTouch> numb)
    : numb_(std::move(numb)),
      lanes_(to_index(sensors.touch.lanes())),
      joint_offset_rad_(sensors.joint_angle_rad.rows(), sensors.touch.lanes()),
      attitude_offset_rad_(sensors.attitude_rad.rows(), sensors.touch.lanes()) {
  for (int lane = 0; lane < sensors.touch.lanes(); ++lane) load(lane, nullptr);
}

void Disturbances::load(int lane, const Scenario* scenario) {
  Lane& slot = lanes_[to_index(lane)];
  disturbed_ += (scenario != nullptr) - (slot.scenario != nullptr);
  slot.scenario = scenario;
  slot.step = 0;
  slot.next_push = slot.next_flip = 0;
  slot.delayed_rad.clear();
  for (int j = 0; j < joint_offset_rad_.rows(); ++j)
    joint_offset_rad_.at(j, lane) = scenario ? scenario->joint_sensor_rad[to_index(j)] : no_offset;
  for (int a = 0; a < attitude_offset_rad_.rows(); ++a)
    attitude_offset_rad_.at(a, lane) = scenario ? scenario->attitude_sensor_rad[to_index(a)] : no_offset;
}

const robot::SensorFrame& Disturbances::read(const robot::SensorFrame& sensors) {
  if (disturbed_ == 0 && numb_.empty()) return sensors;
  read_ = sensors;
  add(joint_offset_rad_, read_.joint_angle_rad);
  add(attitude_offset_rad_, read_.attitude_rad);
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    ++lanes_[i].step;
    if (lanes_[i].scenario != nullptr) flip_touches(lanes_[i], static_cast<int>(i));
    for (const auto& [leg, first_step] : numb_)
      if (lanes_[i].step >= first_step) read_.touch.at(leg, static_cast<int>(i)) = 0.0f;
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

/// Swaps the targets of this tick for those of `latency` ticks ago, at this tick's place in the ring buffer.
void Disturbances::delay(Lane& lane, int index, LaneArray& targets_rad) {
  const auto latency = to_index(lane.scenario->latency_ticks);
  const auto joints = to_index(targets_rad.rows());
  lane.delayed_rad.resize(latency * joints);  // zeros at first
  float* const delayed_rad = lane.delayed_rad.data() + to_index(lane.step) % latency * joints;
  for (std::size_t j = 0; j < joints; ++j)
    std::swap(targets_rad.at(static_cast<int>(j), index), delayed_rad[j]);
}

}  // namespace amble::trial
