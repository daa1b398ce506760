#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "amble/trial/trial.hpp"

namespace amble::trial {

/// A point that moves along x by its target each step, and sinks by 1 mm each step; a target of NaN makes it
/// unhealthy. A push moves it by as many metres as it has N s.
class FakeEngine : public physics::Engine {
 public:
  explicit FakeEngine(int lanes) : states_(static_cast<std::size_t>(lanes)) {
    frame_.joint_angle_rad = LaneArray(1, lanes);
    frame_.touch = LaneArray(1, lanes);
    frame_.attitude_rad = LaneArray(3, lanes);
  }
  int lanes() const override { return static_cast<int>(states_.size()); }
  void place(int lane) override {
    state(lane) = {.placed = true, .position = {0, 0, 1.0}};
    frame_.joint_angle_rad.at(0, lane) = start_angle_rad;
  }
  void place_at(int lane, const physics::StartPose& pose) override {
    state(lane) = {.placed = true, .position = pose.root.position_m, .rotation = pose.root.rotation};
  }
  void place_moving(int lane, const physics::MovingPose& motion) override { place_at(lane, motion.pose); }
  physics::MovingPose motion(int lane) const override {
    return {.pose = {root_pose(lane), {0.0}},
            .velocity_m_s = {},
            .angular_velocity_rad_s = {},
            .joint_speed_rad_s = {0.0}};
  }
  void push(int lane, Vec3 impulse_n_s) override {
    pushed_n_s = pushed_n_s + impulse_n_s;
    state(lane).position = state(lane).position + impulse_n_s;
  }
  void retire(int lane) override { state(lane).placed = false; }
  void step(const LaneArray& targets_rad) override {
    ++steps;
    for (int lane = 0; lane < lanes(); ++lane) {
      if (!state(lane).placed) continue;
      ++moved;
      state(lane).position.x += targets_rad.at(0, lane);
      state(lane).position.z -= 0.001;
      frame_.touch.at(0, lane) = steps >= foot_down_from ? 1.0f : 0.0f;
    }
  }
  bool healthy(int lane) const override { return std::isfinite(state(lane).position.x); }
  const robot::SensorFrame& sensors() const override { return frame_; }
  robot::SensorFrame& frame() { return frame_; }
  const LaneArray* motor_torque_nm() const override { return nullptr; }
  physics::RootPose root_pose(int lane) const override {
    return {state(lane).position, state(lane).rotation};
  }
  Vec3 root_com_m(int lane) const override { return state(lane).position; }
  Vec3 com_m(int lane) const override { return state(lane).position; }
  Vec3 momentum_kg_m_s(int) const override { return {}; }
  std::uint64_t state_hash(int lane) const override {
    return static_cast<std::uint64_t>(state(lane).position.x * 1e6);
  }

  int steps = 0;
  int moved = 0;
  Vec3 pushed_n_s;               ///< all pushes of all lanes
  float start_angle_rad = 0.0f;  ///< what a joint's sensor says from the start on
  /// Its foot touches the ground in every step from this one on.
  int foot_down_from = std::numeric_limits<int>::max();

 private:
  struct State {
    bool placed = false;
    Vec3 position;
    Quat rotation = {};
  };
  State& state(int lane) { return states_[static_cast<std::size_t>(lane)]; }
  const State& state(int lane) const { return states_[static_cast<std::size_t>(lane)]; }
  std::vector<State> states_;
  robot::SensorFrame frame_;
};

/// Always the same target; not a number after `bad_after` ticks.
struct FakeParameters : controllers::Parameters {
  explicit FakeParameters(float target, int bad_after = std::numeric_limits<int>::max())
      : target_rad(target), bad_after_ticks(bad_after) {}
  float target_rad;
  int bad_after_ticks;
};

class FakeBatch : public controllers::Batch {
 public:
  explicit FakeBatch(int lanes) : loaded_(static_cast<std::size_t>(lanes)), ticks_(loaded_.size()) {}
  int lanes() const override { return static_cast<int>(loaded_.size()); }
  void load(int lane, const controllers::Parameters& parameters) override {
    loaded_[static_cast<std::size_t>(lane)] = &dynamic_cast<const FakeParameters&>(parameters);
    ticks_[static_cast<std::size_t>(lane)] = 0;
  }
  void step(const robot::SensorFrame&, LaneArray& targets_rad) override {
    for (std::size_t lane = 0; lane < loaded_.size(); ++lane) {
      if (!loaded_[lane]) continue;
      const bool bad = ++ticks_[lane] > loaded_[lane]->bad_after_ticks;
      targets_rad.at(0, static_cast<int>(lane)) =
          bad ? std::numeric_limits<float>::quiet_NaN() : loaded_[lane]->target_rad;
    }
  }
  std::vector<std::string> state_names() const override { return {}; }
  void state(int, std::span<float>) const override {}

 private:
  std::vector<const FakeParameters*> loaded_;
  std::vector<int> ticks_;
};

/// Tasks in order; all under the same scenario, if any.
class Queue : public TaskQueue {
 public:
  explicit Queue(std::vector<FakeParameters> tasks, const Scenario* scenario = nullptr)
      : tasks_(std::move(tasks)), scenario_(scenario), results(tasks_.size()) {}
  std::optional<Task> next() override {
    if (next_ == tasks_.size()) return std::nullopt;
    const std::size_t index = next_++;
    return Task{index, std::make_unique<FakeParameters>(tasks_[index]), nullptr, scenario_};
  }
  void done(std::size_t index, record::Trajectory trajectory) override {
    results[index] = std::move(trajectory);
  }

 private:
  std::vector<FakeParameters> tasks_;
  const Scenario* scenario_;
  std::size_t next_ = 0;

 public:
  std::vector<std::optional<record::Trajectory>> results;
};

}  // namespace amble::trial
