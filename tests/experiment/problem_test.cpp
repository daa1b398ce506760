#include "amble/experiment/problem.hpp"

#include <gtest/gtest.h>

#include "tests/experiment/fixture.hpp"

namespace amble::experiment {
namespace {

TEST(Problem, EveryTrialStartsDropMAboveTheStartPose) {
  constexpr double drop_m = 0.25;
  auto noise = all_noise();
  noise.push_back("noise.start_height_m=0");
  auto high = noise;
  high.push_back("drop_m=0.25");
  auto low_problem = small_problem(small_config(noise)), high_problem = small_problem(small_config(high));
  for (const char* name : {"ode", "batch", "mujoco"}) {
    low_problem.engine = high_problem.engine = name;
    const auto low_engine = low_problem.make_engine(), high_engine = high_problem.make_engine();
    low_engine->place(0);
    high_engine->place(0);
    EXPECT_NEAR(high_engine->root_pose(0).position_m.z - low_engine->root_pose(0).position_m.z, drop_m, 1e-6);
    for (int leg = 0; leg < 4; ++leg) {
      EXPECT_EQ(low_engine->sensors().touch.at(leg, 0), 1.0f) << name;
      EXPECT_EQ(high_engine->sensors().touch.at(leg, 0), 0.0f) << name;
    }
  }
  const trial::ScenarioKey key{.seed = 1, .generation = 2, .episode = 0};
  const auto low_start = low_problem.scenario(key).start, high_start = high_problem.scenario(key).start;
  EXPECT_NEAR(high_start->root.position_m.z - low_start->root.position_m.z, drop_m, 1e-5);
}

}  // namespace
}  // namespace amble::experiment
