#include <gtest/gtest.h>

#include "amble/experiment/problem/problem_json.hpp"
#include "amble/experiment/replay.hpp"
#include "amble/experiment/verify.hpp"
#include "tests/experiment/fixture.hpp"

// Runs of SUPGs that sense and pass over the seam.
namespace amble::experiment {
namespace {

const std::string supg = "controller.supg.";
const std::vector<std::string> sensing{
    "engine=batch",
    supg + "modulation.rate=1",
    supg + "modulation.shape=0.5",
    supg + "modulation.reset=0.5",
    supg + "modulation.refractory_ticks=5",
    supg + R"(modulation.sensors=["pitch","speed.knee","torque.hip_fb","yaw_rate"])",
    supg + "seam.residual_s=0.05",
    supg + "seam.time=circle",
    R"(controller.sensing.sensors=[{of="pitch",noise=0.05,delay_s=0.02},{of="speed",scale=0.5,dead_time_s=0.03}])",
    "noise.episodes=2"};

TEST(SensingRun, IsTheSameForAnyNumberOfWorkersAndAfterAnInterruptionAndIsVerified) {
  const TemporaryFolder scratch;
  const Config config = small_config(sensing);
  Listener one, three, first(2), second;
  ASSERT_EQ(Run::start(scratch / "one", config, 1).execute(one, one.stop), RunStatus::finished);
  ASSERT_EQ(Run::start(scratch / "three", config, 3).execute(three, three.stop), RunStatus::finished);
  ASSERT_EQ(Run::start(scratch / "two", config, 2).execute(first, first.stop), RunStatus::interrupted);
  ASSERT_EQ(Run::resume(scratch / "two", {}, 1).execute(second, second.stop), RunStatus::finished);
  const std::string expected = champion_bytes(scratch / "one");
  EXPECT_GT(expected.size(), 1000u);
  EXPECT_TRUE(champion_bytes(scratch / "three") == expected);
  EXPECT_TRUE(champion_bytes(scratch / "two") == expected);
  const RunPaths paths(scratch / "one");
  const Origin origin = origin_of(paths);
  for (const auto& file : paths.champion_files()) {
    const auto verified = verify_champion(file, unstopped, &origin);
    EXPECT_TRUE(verified->agrees) << verified->text;
    EXPECT_EQ(load_champion(file).problem.controller.supg.modulation.sensors.size(), 4u);
  }
}

TEST(SensingRun, LeavesIdentityAndChampionsWithoutItAsTheyWere) {
  const io::Json before = identity_json(small_config()).at("controller");
  EXPECT_FALSE(before.contains("sensing"));
  for (const char* const table : {"seam", "contact", "modulation"})
    EXPECT_FALSE(before.at("supg").contains(table));
  EXPECT_FALSE(problem_json(small_problem()).at("controller").contains("sensing"));
  const io::Json after = identity_json(small_config(sensing)).at("controller");
  EXPECT_TRUE(after.contains("sensing"));
  EXPECT_TRUE(after.at("supg").contains("modulation"));
  EXPECT_FALSE(after.at("supg").contains("contact"));
}

TEST(SensingRun, WalksInEveryEngineByContactsThatAreGuessed) {
  const std::vector<std::pair<std::string, std::string>> sources{
      {"torque", "3"}, {"tracking", "0.05"}, {"shock", "5"}};
  for (const char* const engine : {"ode", "batch", "mujoco"})
    for (const auto& [source, threshold] : sources) {
      const Problem problem = small_problem(
          small_config({std::string("engine=") + engine, "trial.duration_s=5",
                        supg + "contact.source=" + source, supg + "contact.threshold=" + threshold}));
      const auto genome = small_population(problem).genomes()[0];
      std::int64_t triggers = 0;
      const auto walked = replay(problem, genome, {}, unstopped);
      for (const auto& [name, count] : walked->events) triggers += count;
      EXPECT_GT(triggers, 0) << engine << " " << source;
    }
}

TEST(SensingRun, NoiseOfASensorMakesEpisodesDiffer) {
  const Config config = small_config(sensing);
  EXPECT_TRUE(small_problem(config).trials_vary());
  EXPECT_EQ(small_problem(config).scenarios(1, 0).size(), 2u);
  EXPECT_THROW(small_config({"noise.episodes=2"}), UserError);
}

}  // namespace
}  // namespace amble::experiment
