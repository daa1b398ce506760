#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "amble/experiment/replay.hpp"
#include "amble/experiment/verify.hpp"
#include "tests/experiment/fixture.hpp"

// The tasks of configs/tasks.
namespace amble::experiment {
namespace {

class Task : public testing::TestWithParam<const char*> {
 protected:
  static Config config(const std::string& ending, double steps, std::vector<std::string> more = {}) {
    const std::string file = std::string(AMBLE_SOURCE_DIR "/configs/tasks/") + GetParam() + ending;
    const double timestep_s = load_config(file, {}).trial.timestep_s;
    more.insert(more.begin(),
                {"population.size=6", "trial.duration_s=" + std::to_string(steps * timestep_s)});
    return load_config(file, {.assignments = std::move(more), .seed = 1, .generations = 2});
  }
  TemporaryFolder scratch_;
};
INSTANTIATE_TEST_SUITE_P(Tasks, Task, testing::Values("ant", "half_cheetah", "hopper", "swimmer", "walker2d"),
                         [](const auto& of) { return std::string(of.param); });

TEST_P(Task, EvolvesWithEachControllerAndItsChampionIsVerified) {
  int number = 0;
  for (const auto& [ending, setting] : {std::pair{".toml", "controller.kind=supg"},
                                        {".toml", "controller.kind=ctrnn"},
                                        {".toml", "controller.kind=network"},
                                        {"-oscillators.toml", "controller.oscillators.reset=none"},
                                        {"-oscillators.toml", "controller.oscillators.reset=touch"}}) {
    const Config made = config(ending, 20, {setting});
    Listener listener;
    const auto folder = scratch_ / std::to_string(number++);
    ASSERT_EQ(Run::start(folder, made, load_robot(made), 2).execute(listener, listener.stop),
              RunStatus::finished);
    const RunPaths paths(folder);
    const Origin origin = origin_of(paths);
    EXPECT_TRUE(verify_champion(paths.best_champion(), unstopped, &origin)->agrees) << setting;
  }
}

TEST_P(Task, LastsAThousandSteps) {
  const Config made = load_config(std::string(AMBLE_SOURCE_DIR "/configs/tasks/") + GetParam() + ".toml", {});
  EXPECT_EQ(made.trial.steps(), 1000);
  EXPECT_EQ(made.engine, "mujoco-model");
  // Speed along x of weight 1 a step; 1 a step for living, or nothing.
  for (const score::Term& term : made.score.terms) {
    if (term.quantity == "root_forward") {
      EXPECT_NEAR(term.weight * made.trial.timestep_s, 1.0, 1e-12);
    }
    if (term.quantity == "upright_time") {
      EXPECT_EQ(term.weight, 1000.0);
    }
  }
}

}  // namespace
}  // namespace amble::experiment
