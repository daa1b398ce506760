#include <gtest/gtest.h>

#include <cmath>
#include <thread>
#include <vector>

#include "amble/core/hash.hpp"
#include "tests/physics/scene.hpp"

namespace amble::physics {
namespace {

/// Walks about on the spot, differently for each `gait`, and hashes every state on the way.
std::uint64_t trial(Engine& engine, int gait, int steps = 300) {
  LaneArray targets(12, 1);
  std::vector<std::uint64_t> hashes;
  engine.place(0);
  for (int n = 0; n < steps; ++n) {
    for (int j = 0; j < 12; ++j)
      targets.at(j, 0) = 0.6f * static_cast<float>(std::sin(0.06 * n + 1.7 * gait * j));
    engine.step(targets);
    hashes.push_back(engine.state_hash(0));
  }
  EXPECT_TRUE(engine.healthy(0));
  return hash_span<std::uint64_t>(hashes);
}

class Determinism : public OnEachEngine {};
ON_EACH_REFEREE(Determinism);

TEST_P(Determinism, ATrialDoesNotDependOnWhatRanBefore) {
  for (const bool self_collision : {false, true}) {
    robot::RobotSpec robot = quadruped();
    robot.self_collision = self_collision;
    const auto engine = make_engine(GetParam(), robot, {});
    const std::uint64_t first = trial(*engine, 1);
    const std::uint64_t other = trial(*engine, 2);
    EXPECT_NE(first, other);
    EXPECT_EQ(trial(*engine, 1), first);
    EXPECT_EQ(trial(*make_engine(GetParam(), robot, {}), 1), first);
  }
}

TEST_P(Determinism, TrialsOfSeveralEnginesCanBeInterleaved) {
  const robot::RobotSpec robot = quadruped("paper");
  const auto one = make_engine(GetParam(), robot, {});
  const auto two = make_engine(GetParam(), robot, {});
  LaneArray targets(12, 1);
  one->place(0);
  two->place(0);
  for (int n = 0; n < 200; ++n) {
    for (int j = 0; j < 12; ++j) targets.at(j, 0) = 0.5f * static_cast<float>(std::sin(0.1 * n + j));
    one->step(targets);
    two->step(targets);
    ASSERT_EQ(one->state_hash(0), two->state_hash(0)) << n;
  }
}

TEST_P(Determinism, ThreadsDoNotDisturbEachOther) {
  const robot::RobotSpec robot = quadruped();
  constexpr int gaits = 3;
  std::vector<std::uint64_t> alone;
  const auto engine = make_engine(GetParam(), robot, {});
  for (int gait = 0; gait < gaits; ++gait) alone.push_back(trial(*engine, gait, 150));

  std::vector<std::vector<std::uint64_t>> together(2);
  {
    std::vector<std::jthread> threads;
    for (auto& hashes : together) {
      threads.emplace_back([&robot, &hashes] {
        const auto own = make_engine(GetParam(), robot, {});
        for (int gait = 0; gait < gaits; ++gait) hashes.push_back(trial(*own, gait, 150));
      });
    }
  }
  EXPECT_EQ(together[0], alone);
  EXPECT_EQ(together[1], alone);
}

TEST_P(Determinism, AnEngineMayBeMadeInOneThreadAndUsedInAnother) {
  const robot::RobotSpec robot = quadruped();
  const auto engine = make_engine(GetParam(), robot, {});
  std::uint64_t elsewhere = 0;
  std::jthread([&] { elsewhere = trial(*engine, 1, 50); }).join();
  EXPECT_EQ(trial(*make_engine(GetParam(), robot, {}), 1, 50), elsewhere);
}

}  // namespace
}  // namespace amble::physics
