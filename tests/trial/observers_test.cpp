#include "amble/trial/observers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "tests/trial/fakes.hpp"

namespace amble::trial {
namespace {

using Story = std::vector<std::vector<float>>;

/// Controllers whose recorded state is told beforehand, tick by tick.
class ToldBatch : public FakeBatch {
 public:
  ToldBatch(std::vector<std::string> names, Story story, std::vector<std::size_t> events = {})
      : FakeBatch(1), names_(std::move(names)), story_(std::move(story)), events_(std::move(events)) {}
  void step(const robot::SensorFrame& sensors, LaneArray& targets_rad) override {
    FakeBatch::step(sensors, targets_rad);
    ++tick_;
  }
  std::vector<std::string> state_names() const override { return names_; }
  std::vector<std::size_t> events() const override { return events_; }
  void state(int, std::span<float> values) const override {
    std::ranges::copy(story_[tick_ - 1], values.begin());
  }

 private:
  std::vector<std::string> names_;
  Story story_;
  std::vector<std::size_t> events_;
  std::size_t tick_ = 0;
};

void run(controllers::Batch& batch, Observer& observer, int steps, float target_rad = 1.0f) {
  FakeEngine engine(1);
  Protocol protocol;
  protocol.steps = steps;
  protocol.fall.below_m = 0.0;
  const std::atomic<bool> never{false};
  OneTask task(std::make_unique<FakeParameters>(target_rad), &observer);
  Runner(engine, batch, protocol).run(task, never);
}

TEST(EventObserver, CountsTheEventsOfAControllerAndNothingElse) {
  // States that are 1 as often without being events.
  ToldBatch batch({"timer.A", "timer.B", "trigger.A", "trigger.B", "untrigger.A"},
                  {{1, 5, 0, 1, 1}, {2, 6, 0, 1, 1}, {0, 7, 1, 0, 1}, {1, 0, 0, 1, 1}}, {2, 3});
  EventObserver observer(batch);
  run(batch, observer, 4);
  ASSERT_EQ(observer.counts().size(), 2u);
  EXPECT_EQ(observer.counts()[0].name, "trigger.A");
  EXPECT_EQ(observer.counts()[0].count, 1);
  EXPECT_EQ(observer.counts()[1].name, "trigger.B");
  EXPECT_EQ(observer.counts()[1].count, 3);
}

TEST(EventObserver, HasNothingToCountForControllersWithoutEvents) {
  ToldBatch batch({"neuron.a"}, {{1}, {1}});
  EventObserver observer(batch);
  run(batch, observer, 2);
  EXPECT_TRUE(observer.counts().empty());
}

TEST(TraceObserver, HasOneEntryPerStepThatDependsOnTheStateInIt) {
  const auto trace_of = [](float target_rad) {
    FakeBatch batch(1);
    TraceObserver observer;
    run(batch, observer, 5, target_rad);
    return observer.trace();
  };
  const auto trace = trace_of(1.0f);
  EXPECT_EQ(trace, (std::vector<std::uint32_t>{1000000, 2000000, 3000000, 4000000, 5000000}));
  EXPECT_EQ(trace_of(0.5f)[1], trace[0]);
}

TEST(ObserverList, PassesEachStepToAllInOrder) {
  FakeBatch batch(1);
  TraceObserver first, second;
  ObserverList both;
  both.add(first);
  both.add(second);
  run(batch, both, 3);
  EXPECT_EQ(first.trace().size(), 3u);
  EXPECT_EQ(first.trace(), second.trace());
}

}  // namespace
}  // namespace amble::trial
