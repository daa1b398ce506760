#include "amble/trial/trial.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace amble::trial {
namespace {

/// A point that moves along x by its target each step, and sinks by 1 mm each step; a target of NaN makes it
/// unhealthy.
class FakeEngine : public physics::Engine {
 public:
  explicit FakeEngine(int lanes) : states_(static_cast<std::size_t>(lanes)) {
    frame_.joint_angle_rad = LaneArray(1, lanes);
    frame_.touch = LaneArray(1, lanes);
    frame_.attitude_rad = LaneArray(3, lanes);
  }
  int lanes() const override { return static_cast<int>(states_.size()); }
  void place(int lane) override { state(lane) = {.placed = true, .position = {0, 0, 1.0}}; }
  void retire(int lane) override { state(lane).placed = false; }
  void step(const LaneArray& targets_rad) override {
    ++steps;
    for (int lane = 0; lane < lanes(); ++lane) {
      if (!state(lane).placed) continue;
      ++moved;
      state(lane).position.x += targets_rad.at(0, lane);
      state(lane).position.z -= 0.001;
    }
  }
  bool healthy(int lane) const override { return std::isfinite(state(lane).position.x); }
  const physics::SensorFrame& sensors() const override { return frame_; }
  physics::RootPose root_pose(int lane) const override { return {state(lane).position, {}}; }
  Vec3 root_com_m(int lane) const override { return state(lane).position; }
  Vec3 com_m(int lane) const override { return state(lane).position; }
  Vec3 momentum(int) const override { return {}; }
  std::uint64_t state_hash(int lane) const override {
    return static_cast<std::uint64_t>(state(lane).position.x * 1e6);
  }

  int steps = 0;
  int moved = 0;

 private:
  struct State {
    bool placed = false;
    Vec3 position;
  };
  State& state(int lane) { return states_[static_cast<std::size_t>(lane)]; }
  const State& state(int lane) const { return states_[static_cast<std::size_t>(lane)]; }
  std::vector<State> states_;
  physics::SensorFrame frame_;
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
  void step(const physics::SensorFrame&, LaneArray& targets_rad) override {
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

class Queue : public TaskQueue {
 public:
  explicit Queue(std::vector<FakeParameters> tasks) : tasks_(std::move(tasks)), results(tasks_.size()) {}
  std::optional<Task> next() override {
    if (next_ == tasks_.size()) return std::nullopt;
    const std::size_t index = next_++;
    return Task{index, std::make_unique<FakeParameters>(tasks_[index]), nullptr};
  }
  void done(std::size_t index, record::Trajectory trajectory) override {
    results[index] = std::move(trajectory);
  }

 private:
  std::vector<FakeParameters> tasks_;
  std::size_t next_ = 0;

 public:
  std::vector<std::optional<record::Trajectory>> results;
};

const std::atomic<bool> never{false};

Protocol protocol(int steps, double fall_height_m = 0.0, int path_stride = 0) {
  return {.steps = steps, .timestep_s = 0.01, .path_stride = path_stride, .fall_height_m = fall_height_m};
}

TEST(Runner, StopsACompletedTrialAfterItsLastStep) {
  FakeEngine engine(1);
  FakeBatch batch(1);
  Queue queue({FakeParameters(0.5f)});
  Runner(engine, batch, protocol(7)).run(queue, never);
  const auto& trajectory = queue.results[0].value();
  EXPECT_EQ(trajectory.outcome, record::Outcome::completed);
  EXPECT_EQ(trajectory.steps, 7);
  EXPECT_DOUBLE_EQ(trajectory.com_end_m.x, 3.5);
  EXPECT_EQ(engine.steps, 7);
}

TEST(Runner, EndsATrialInTheStepThatBringsTheRootBelowTheFallHeight) {
  FakeEngine engine(1);
  FakeBatch batch(1);
  Queue queue({FakeParameters(1.0f)});
  Runner(engine, batch, protocol(100, 0.9895)).run(queue, never);
  const auto& trajectory = queue.results[0].value();
  EXPECT_EQ(trajectory.outcome, record::Outcome::fell);
  EXPECT_EQ(trajectory.steps, 11);  // 1 − 11 mm is the first height below 0.9895 m
  EXPECT_DOUBLE_EQ(trajectory.com_end_m.x, 11.0);
}

TEST(Runner, KeepsTheLastHealthyPositionOfATrialThatDiverges) {
  FakeEngine engine(1);
  FakeBatch batch(1);
  Queue queue({FakeParameters(1.0f, 4)});
  Runner(engine, batch, protocol(100)).run(queue, never);
  const auto& trajectory = queue.results[0].value();
  EXPECT_EQ(trajectory.outcome, record::Outcome::diverged);
  EXPECT_EQ(trajectory.steps, 5);
  EXPECT_DOUBLE_EQ(trajectory.com_end_m.x, 4.0);
}

TEST(Runner, SamplesThePathEveryStrideStepsRelativeToTheStart) {
  FakeEngine engine(1);
  FakeBatch batch(1);
  Queue queue({FakeParameters(0.25f)});
  Runner(engine, batch, protocol(7, 0.0, 3)).run(queue, never);
  EXPECT_EQ(queue.results[0]->com_path_m, (std::vector<float>{0.75f, 0.0f, 1.5f, 0.0f}));
}

TEST(Runner, RefillsALaneInTheStepAfterItsTrialEnded) {
  // Two lanes, trials of 2 and 8 steps in turn: lane 0 runs four short ones while lane 1 runs a long one.
  FakeEngine engine(2);
  FakeBatch batch(2);
  const FakeParameters diverges_at_2(1.0f, 1), lasts(1.0f);
  Queue queue({diverges_at_2, lasts, diverges_at_2, diverges_at_2, diverges_at_2});
  Runner runner(engine, batch, protocol(8));
  runner.run(queue, never);
  EXPECT_EQ(engine.steps, 8);
  EXPECT_EQ(engine.moved, 16);
  EXPECT_EQ(runner.steps_simulated(), 16u);
}

TEST(Runner, GivesEveryTrialTheSameResultForAnyNumberOfLanes) {
  std::vector<FakeParameters> tasks;
  for (int i = 0; i < 37; ++i) tasks.emplace_back(0.125f * static_cast<float>(i), 1 + (i * 7) % 19);
  std::vector<std::vector<double>> ends;
  for (const int lanes : {1, 2, 8, 16, 64}) {
    FakeEngine engine(lanes);
    FakeBatch batch(lanes);
    Queue queue(tasks);
    Runner(engine, batch, protocol(12)).run(queue, never);
    ends.emplace_back();
    for (const auto& result : queue.results) ends.back().push_back(result.value().com_end_m.x);
  }
  for (const auto& other : ends) EXPECT_EQ(other, ends.front());
}

TEST(Runner, DoesNothingWithAnEmptyQueue) {
  FakeEngine engine(4);
  FakeBatch batch(4);
  Queue queue({});
  Runner(engine, batch, protocol(8)).run(queue, never);
  EXPECT_EQ(engine.steps, 0);
}

TEST(Runner, DropsTrialsInFlightWhenItIsStopped) {
  class StopAt : public Observer {
   public:
    explicit StopAt(std::atomic<bool>& stop) : stop_(stop) {}
    void on_step(int step, const physics::Engine&, const controllers::Batch&, const LaneArray&,
                 int) override {
      if (step == 3) stop_ = true;
    }

   private:
    std::atomic<bool>& stop_;
  };
  std::atomic<bool> stop{false};
  StopAt observer(stop);
  FakeEngine engine(1);
  FakeBatch batch(1);
  OneTask task(std::make_unique<FakeParameters>(1.0f), &observer);
  Runner(engine, batch, protocol(100)).run(task, stop);
  EXPECT_FALSE(task.result());
  EXPECT_EQ(engine.steps, 3);
}

}  // namespace
}  // namespace amble::trial
