#include <gtest/gtest.h>

#include "amble/io/file.hpp"
#include "tests/experiment/fixture.hpp"
#include "tests/robot/legged.hpp"

// Runs whose substrates are made from the robot (controllers/automatic.hpp).
namespace amble::experiment {
namespace {

const std::vector<std::string> kinds{"supg", "sine", "ctrnn"};

Config config_of(const std::string& kind, std::vector<std::string> more = {}) {
  Overrides overrides{.assignments = {"engine=batch", "population.size=40", "trial.duration_s=1"},
                      .seed = 5,
                      .generations = 3};
  overrides.assignments.insert(overrides.assignments.end(), more.begin(), more.end());
  return load_config(std::string(AMBLE_SOURCE_DIR) + "/configs/authors/" + kind + "-objective.toml",
                     overrides);
}

Config automatic_config(const std::string& kind) {
  return config_of(kind, {"controller.substrate=auto"});
}

/// The bytes of a run's champion files.
std::string champions(const std::filesystem::path& folder, const Config& config) {
  Listener listener;
  EXPECT_EQ(Run::start(folder, config, 1).execute(listener, listener.stop), RunStatus::finished);
  std::string all;
  for (const auto& file : RunPaths(folder).champion_files()) all += io::read_file(file);
  return all;
}

TEST(AutomaticRun, OfTheQuadrupedHasTheChampionsOfTheListedSubstrateByteForByte) {
  const TemporaryFolder scratch;
  for (const std::string& kind : kinds) {
    const std::string listed = champions(scratch / (kind + "-listed"), config_of(kind));
    EXPECT_GT(listed.size(), 1000u);
    EXPECT_TRUE(champions(scratch / (kind + "-auto"), automatic_config(kind)) == listed) << kind;
  }
}

TEST(AutomaticRun, EvolvesEveryKindOfControllerOnRobotsOfOtherLegs) {
  const auto quadruped = tests::legged_robot(2);
  const std::pair<const char*, robot::RobotSpec> robots[] = {
      {"quadruped", quadruped},
      {"lacking", tests::without_hip_io(quadruped, 2)},
      {"holding", tests::with_held_joint(quadruped, 1, 0)},
      {"hexapod", tests::legged_robot(3)},
      {"biped", tests::legged_robot(1)}};
  const TemporaryFolder scratch;
  for (const auto& [name, robot] : robots) {
    const auto file = scratch / (std::string(name) + ".json");
    io::write_file(file, robot_file_text(robot));
    for (const std::string& kind : kinds) {
      Config config = automatic_config(kind);
      config.robot = file;
      const auto folder = scratch / (name + kind);
      Listener listener;
      ASSERT_EQ(Run::start(folder, config, 1).execute(listener, listener.stop), RunStatus::finished);
      ASSERT_EQ(listener.rows.size(), 3u);
      // Robots that walk on their own legs move.
      EXPECT_GT(listener.rows.back().best, 0.001) << name << kind;
      const auto champion = load_champion(RunPaths(folder).champion_files().back());
      EXPECT_EQ(champion.problem.controller.substrate.layout, substrate::LayoutSource::listed);
      EXPECT_FALSE(champion.problem.controller.substrate.nodes.empty());
    }
  }
}

TEST(AutomaticRun, LeavesTheIdentityOfConfigsWithListsAsItWas) {
  for (const std::string& kind : kinds) {
    const auto listed = identity_json(config_of(kind));
    EXPECT_FALSE(listed["controller"]["substrate"].contains("layout"));
    EXPECT_EQ(identity_json(automatic_config(kind))["controller"]["substrate"]["layout"], "auto");
  }
}

TEST(AutomaticRun, WritesItsConfigInFull) {
  const TemporaryFolder scratch;
  const Config config = automatic_config("sine");
  io::write_file(scratch / "full.toml", config.to_toml());
  const Config again = load_config(scratch / "full.toml", {});
  EXPECT_EQ(again.to_toml(), config.to_toml());
  EXPECT_EQ(again.controller.substrate.layout, substrate::LayoutSource::automatic);
}

}  // namespace
}  // namespace amble::experiment
