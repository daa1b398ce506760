#include "amble/experiment/problem.hpp"

#include <gtest/gtest.h>

#include "amble/experiment/replay.hpp"
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

/// What the first joint was told in each step, and the leg's timer.
class FirstSteps : public trial::Observer {
 public:
  void on_step(int, const physics::Engine& engine, const controllers::Batch& controllers,
               const LaneArray& targets_rad, int lane) override {
    std::vector<float> targets(static_cast<std::size_t>(targets_rad.rows()));
    for (int joint = 0; joint < targets_rad.rows(); ++joint)
      targets[static_cast<std::size_t>(joint)] = targets_rad.at(joint, lane);
    targets_rad_.push_back(std::move(targets));
    std::vector<float> state(controllers.state_names().size());
    controllers.state(lane, state);
    states_.push_back(std::move(state));
    angles_rad_.push_back(engine.sensors().joint_angle_rad.at(0, lane));
  }
  std::vector<std::vector<float>> targets_rad_, states_;
  std::vector<float> angles_rad_;
};

TEST(Problem, ControllersThatActAfterTheFirstStepAreOneTickLateInEveryEngine) {
  // Five ticks: no foot has come up and down again, so a SUPG's targets hang on its own clock alone.
  constexpr int steps = 5;
  for (const char* name : {"ode", "batch", "mujoco"}) {
    FirstSteps early, late;
    for (const bool after : {false, true}) {
      auto problem = small_problem(
          small_config({"trial.duration_s=0.05",
                        std::string("trial.first_command=") + (after ? "after" : "before") + "_first_step"}));
      problem.engine = name;
      const auto genome = small_population(problem).genomes().front();
      ReplayOptions options;
      options.observer = after ? &late : &early;
      replay(problem, genome, options, std::atomic<bool>(false));
    }
    ASSERT_EQ(late.targets_rad_.size(), static_cast<std::size_t>(steps)) << name;
    EXPECT_EQ(late.targets_rad_[0], std::vector<float>(12)) << name << ": holds the start pose";
    EXPECT_NEAR(late.angles_rad_[0], 0.0f, 1e-3) << name;
    for (std::size_t leg = 0; leg < 4; ++leg) EXPECT_EQ(late.states_[0][leg], -1.0f) << "has not begun";
    for (std::size_t step = 1; step < steps; ++step) {
      EXPECT_EQ(late.targets_rad_[step], early.targets_rad_[step - 1]) << name << ", step " << step;
      EXPECT_EQ(late.states_[step], early.states_[step - 1]) << name << ", step " << step;
    }
  }
}

}  // namespace
}  // namespace amble::experiment
