#include "amble/experiment/config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "amble/core/error.hpp"
#include "amble/io/file.hpp"
#include "tests/experiment/fixture.hpp"

namespace amble::experiment {
namespace {

const std::string configs = std::string(AMBLE_SOURCE_DIR) + "/configs/";
const std::vector<std::string> presets{"authors/supg-objective.toml",  "paper/supg-objective.toml",
                                       "authors/sine-objective.toml",  "paper/sine-objective.toml",
                                       "authors/ctrnn-objective.toml", "paper/ctrnn-objective.toml"};

TEST(Config, WrittenInFullReadsBackToTheSameText) {
  const TemporaryFolder scratch;
  for (const std::string& preset : presets) {
    const auto config = load_config(configs + preset, {});
    io::write_file(scratch / "full.toml", config.to_toml());
    const auto again = load_config(scratch / "full.toml", {});
    EXPECT_EQ(again.to_toml(), config.to_toml());
  }
}

TEST(Config, PresetsHaveThePapersNumbers) {
  for (const std::string& preset : presets) {
    const auto config = load_config(configs + preset, {});
    EXPECT_EQ(config.neat.population.size, 300);
    EXPECT_EQ(config.generations, 800);
    EXPECT_EQ(config.neat.mutation.add_link_share, 0.06);
    EXPECT_EQ(config.neat.mutation.add_node_share, 0.01);
    EXPECT_EQ(config.neat.reproduction.elitism, 0.1);
    EXPECT_EQ(config.trial.steps(), 1500);
    EXPECT_EQ(config.engine, "ode");
  }
}

TEST(Config, NoveltyPresetsDifferFromThoseOfTheObjectiveInNothingButSearchAndName) {
  for (const std::string preset : {"authors/", "paper/"}) {
    const auto objective = load_config(configs + preset + "supg-objective.toml", {});
    auto novelty = load_config(configs + preset + "supg-novelty.toml", {});
    EXPECT_EQ(novelty.search.kind, "novelty");
    EXPECT_NE(novelty.name, objective.name);
    novelty.search = objective.search;
    novelty.name = objective.name;
    EXPECT_EQ(novelty.to_toml(), objective.to_toml());
  }
}

TEST(Config, PresetsOfNeatAndCppnsAreWhatTextAndCodeSay) {
  for (const std::string& preset : presets) {
    const auto config = load_config(configs + preset, {});
    const bool authors = preset.starts_with("authors/");
    EXPECT_EQ(config.cppn.recurrent, authors);
    EXPECT_EQ(config.cppn.passes, cppn::Passes::twice_hidden_plus_3);
    EXPECT_EQ(config.neat.speciation.first_step_down, 0.01);
    EXPECT_EQ(config.neat.speciation.first_step_up, authors ? 0.5 : 0.01);
    EXPECT_EQ(config.neat.innovations.scope, neat::InnovationScope::generation);
    EXPECT_EQ(config.neat.innovations.key,
              authors ? neat::InnovationKey::link : neat::InnovationKey::link_and_function);
    EXPECT_EQ(config.neat.reproduction.lone_place, authors ? neat::LonePlace::child : neat::LonePlace::elite);
    EXPECT_EQ(config.trial.first_command,
              authors ? trial::FirstCommand::after_first_step : trial::FirstCommand::before_first_step);
    EXPECT_EQ(config.controller.substrate.attitude,
              authors ? substrate::Attitude::misordered_quaternion : substrate::Attitude::true_angles);
  }
}

TEST(Config, NoveltyPresetsAreWhatTextAndCodeSay) {
  const auto authors = load_config(configs + "authors/supg-novelty.toml", {});
  EXPECT_EQ(authors.make_behaviour()->length(), 1500u);
  EXPECT_EQ(authors.search.novelty.path_first_step, 1);
  EXPECT_EQ(authors.search.novelty.path_stride, 2);
  EXPECT_EQ(authors.search.novelty.distance, search::Distance::squared);
  EXPECT_EQ(authors.search.novelty.compare_with, search::Neighbours::archive);
  EXPECT_FALSE(authors.search.novelty.count_first_members);
  const auto paper = load_config(configs + "paper/supg-novelty.toml", {});
  EXPECT_EQ(paper.make_behaviour()->length(), 3000u);
  EXPECT_EQ(paper.search.novelty.distance, search::Distance::root);
  EXPECT_EQ(paper.search.novelty.compare_with, search::Neighbours::archive_and_population);
  EXPECT_TRUE(paper.search.novelty.count_first_members);
  for (const auto& config : {authors, paper}) {
    EXPECT_EQ(config.search.novelty.neighbours, 15);
    EXPECT_EQ(config.search.novelty.threshold, 1000.0);
    EXPECT_EQ(config.search.novelty.first_members, 15);
  }
}

TEST(Config, PresetsOfThePaperAreWithoutNoise) {
  for (const char* preset : {"authors/supg-objective.toml", "paper/supg-objective.toml",
                             "authors/supg-novelty.toml", "paper/supg-novelty.toml"}) {
    const auto config = load_config(configs + preset, {});
    EXPECT_FALSE(config.noise.any()) << preset;
    EXPECT_EQ(config.noise.episodes, 1) << preset;
  }
}

TEST(Config, RobustPresetDiffersFromTheAuthorsInNoiseDropIdleRuleAndNameAlone) {
  auto robust = load_config(configs + "robust/supg-objective.toml", {});
  const auto authors = load_config(configs + "authors/supg-objective.toml", {});
  EXPECT_TRUE(robust.noise.any());
  EXPECT_GT(robust.noise.episodes, 1);
  EXPECT_GT(robust.drop_m, 0.0);
  EXPECT_EQ(robust.controller.supg.idle, controllers::Idle::wrap);
  robust.noise = {};
  robust.drop_m = authors.drop_m;
  robust.controller.supg.idle = authors.controller.supg.idle;
  EXPECT_EQ(robust.champion.episodes, 16);
  EXPECT_EQ(robust.champion.score, ChampionScore::median);
  robust.champion = authors.champion;
  robust.name = authors.name;
  EXPECT_EQ(robust.to_toml(), authors.to_toml());
}

TEST(Config, FindsItsRobotBesideTheFileThatNamesIt) {
  const auto config = load_config(configs + "authors/supg-objective.toml", {});
  EXPECT_TRUE(std::filesystem::exists(config.robot)) << config.robot;
}

TEST(Config, TakesOverridesInOrderAndBareWordsAsText) {
  const auto config = load_config(configs + "authors/supg-objective.toml",
                                  {.assignments = {"population.size=50", "name=quick", "population.size=60"},
                                   .seed = 9,
                                   .generations = 4});
  EXPECT_EQ(config.neat.population.size, 60);
  EXPECT_EQ(config.name, "quick");
  EXPECT_EQ(config.seed, 9);
  EXPECT_EQ(config.generations, 4);
}

TEST(Config, RefereesAreOtherEnginesThanItsOwn) {
  const auto error_of = [](const std::string& assignment) -> std::string {
    try {
      load_config(configs + "authors/supg-objective.toml",
                  {.assignments = {assignment}, .seed = {}, .generations = {}});
    } catch (const UserError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(error_of("referees=[\"mujoco\", \"batch\"]"), "accepted");
  EXPECT_THAT(error_of("engine=newton"),
              testing::HasSubstr("--set engine=newton: 'engine' = \"newton\": expected ode, batch, mujoco"));
  EXPECT_THAT(error_of("referees=[\"newton\"]"),
              testing::HasSubstr("'referees' names \"newton\": expected ode, batch, mujoco"));
  EXPECT_THAT(error_of("referees=[\"ode\"]"),
              testing::HasSubstr("'referees' names \"ode\", the engine of the run itself"));
  EXPECT_THAT(error_of("referees=[\"mujoco\", \"mujoco\"]"),
              testing::HasSubstr("'referees' names \"mujoco\" twice"));
}

TEST(Config, ErrorsOfIncompatibleSettingsNameWhereTheyWereSet) {
  const TemporaryFolder scratch;
  const auto error_of = [&](const std::string& lines,
                            std::vector<std::string> assignments = {}) -> std::string {
    io::write_file(scratch / "c.toml", "include = [\"" + configs + "authors/supg-novelty.toml\"]\n" + lines);
    try {
      const auto config = load_config(scratch / "c.toml",
                                      {.assignments = std::move(assignments), .seed = {}, .generations = {}});
      Problem::make(config, load_robot(config));
    } catch (const UserError& error) {
      return error.what();
    }
    return "accepted";
  };
  using testing::HasSubstr;
  EXPECT_THAT(error_of("\nengine = \"newton\"\n"),
              HasSubstr("c.toml:3: 'engine' = \"newton\": expected ode"));
  EXPECT_THAT(error_of("referees = [\"ode\"]\n"), HasSubstr("c.toml:2: 'referees' names \"ode\""));
  EXPECT_THAT(error_of("robot = \"none.toml\"\n"),
              testing::MatchesRegex(".*c.toml:2: 'robot': .*none.toml: No such file or directory"));
  EXPECT_THAT(error_of("robot = \"\"\n"), HasSubstr("c.toml:2: 'robot' = \"\": expected the path"));
  EXPECT_THAT(error_of("trial.duration_s = 0.155\n"),
              HasSubstr("c.toml:2: trial.duration_s = 0.155: expected"));
  EXPECT_THAT(error_of("", {"trial.timestep_s=0.011"}), HasSubstr("--set trial.timestep_s=0.011: "));
  EXPECT_THAT(error_of("\n\ncontroller.supg.period_s = 1.0049\n"),
              HasSubstr("c.toml:4: controller.supg.period_s = 1.0049"));
  EXPECT_THAT(error_of("controller.substrate.nodes = []\n"), HasSubstr("c.toml:2: controller.substrate."));
  // The key that is named, where several are at odds, is the one that the config itself sets, and not the
  // file that it includes.
  EXPECT_THAT(error_of("trial.timestep_s = 0.011\n"), HasSubstr("c.toml:2: trial.duration_s = 15: expected"));
  EXPECT_THAT(error_of("[controller.substrate]\nnodes = [\n  { at = [0.0, 0.0] },\n]\n"),
              HasSubstr("c.toml:4: controller.substrate.nodes[0].name"));
  // What was typed is what is to be changed, even where the message speaks of another key.
  EXPECT_THAT(
      error_of("speciation.target_max = 30\n", {"population.size=20"}),
      HasSubstr("--set population.size=20: 'speciation.target_max' = 30: expected at most population.size"));
  EXPECT_THAT(error_of("noise.push_m_s = 1\nnoise.push_interval_s = 0.001\n"),
              HasSubstr("c.toml:3: noise.push_interval_s = 0.001: expected at least one timestep"));
}

TEST(Config, ScalesTheTargetNumberOfSpeciesWithThePopulationUnlessItIsGiven) {
  const auto targets = [](const std::vector<std::string>& assignments) {
    const auto speciation = load_config(AMBLE_SOURCE_DIR "/configs/authors/supg-objective.toml",
                                        {.assignments = assignments, .seed = {}, .generations = {}})
                                .neat.speciation;
    return std::pair(speciation.target_min, speciation.target_max);
  };
  EXPECT_EQ(targets({}), std::pair(28, 30));
  EXPECT_EQ(targets({"population.size=300"}), std::pair(28, 30));
  EXPECT_EQ(targets({"population.size=100"}), std::pair(9, 10));
  EXPECT_EQ(targets({"population.size=3000"}), std::pair(280, 300));
  EXPECT_EQ(targets({"population.size=2"}), std::pair(1, 1));
  EXPECT_EQ(targets({"population.size=100", "speciation.target_max=20"}), std::pair(9, 20));
  EXPECT_EQ(targets({"population.size=100", "speciation.target_min=5"}), std::pair(5, 10));
  for (int size = 2; size < 2000; ++size) {
    neat::Settings settings;
    settings.population.size = size;
    settings.speciation.scale_targets(size);
    EXPECT_NO_THROW(settings.validate()) << size;
  }
}

TEST(Config, WithoutARobotIsRefusedByName) {
  const TemporaryFolder scratch;
  io::write_file(scratch / "c.toml", "seed = 1\n");
  try {
    load_config(scratch / "c.toml", {});
    FAIL() << "accepted";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(),
                testing::HasSubstr("c.toml: 'robot' = \"\": expected the path of a robot file"));
  }
}

TEST(Config, ForStandingStillIsNoTracking) {
  const auto refusal = [](const std::vector<std::string>& assignments) -> std::string {
    try {
      load_config(configs + "authors/supg-objective.toml",
                  {.assignments = assignments, .seed = {}, .generations = {}});
    } catch (const UserError& error) {
      return error.what();
    }
    return "none";
  };
  const std::string tracking = "score.terms=[{quantity='tracking'}]";
  EXPECT_THAT(refusal({tracking}),
              testing::HasSubstr("score.terms[0].quantity = \"tracking\": there are no "
                                 "commands to follow, and standing still would be best"));
  EXPECT_EQ(refusal({tracking, "command.kind=random"}), "none");
  EXPECT_THAT(
      refusal({"search.kind=cma-es", "search.cma_es.step=0.1", "search.cma_es.least_step=0.2"}),
      testing::HasSubstr("search.cma_es.least_step = 0.2: expected less than search.cma_es.step = 0.1"));
}

TEST(Config, PresetsMakeTheArchitecturesOfThePaper) {
  // Inputs and outputs of the CPPN: section 3, figures 6 and 7.
  const std::map<std::string, std::pair<int, int>> sizes{
      {"supg", {3, 2}}, {"sine", {6, 1}}, {"ctrnn", {8, 4}}};
  for (const std::string& preset : presets) {
    const auto config = load_config(configs + preset, {});
    const auto problem = Problem::make(config, load_robot_file(config.robot));
    const auto slash = preset.find('/'), dash = preset.find('-');
    const auto& [inputs, outputs] = sizes.at(preset.substr(slash + 1, dash - slash - 1));
    EXPECT_EQ(problem.cppn_inputs(), inputs) << preset;
    EXPECT_EQ(problem.cppn_outputs(), outputs) << preset;
    EXPECT_EQ(config.controller.ctrnn.state,
              preset.starts_with("authors") ? controllers::StateRule::cleared : controllers::StateRule::kept);
  }
}

}  // namespace
}  // namespace amble::experiment
