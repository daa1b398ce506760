#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amble/experiment/champion.hpp"
#include "amble/physics/batch/batch_engine.hpp"
#include "amble/physics/engine_kinds.hpp"
#include "tests/core/error_of.hpp"
#include "tests/experiment/fixture.hpp"

namespace amble::experiment {
namespace {

using testing::HasSubstr;

/// The batch engine as the engine "own" with a setting of its own, which `seen` is for.
double& seen() {
  static double value = 0.0;
  static const bool registered = [] {
    physics::register_engine(
        {.name = "own",
         .traits = physics::engine_traits("batch"),
         .make =
             [](const robot::RobotSpec& robot, const physics::EngineSettings& settings) {
               value = settings.own.numbers.at("stiffness");
               return physics::make_batch_engine(robot, settings);
             },
         .numbers = {{.name = "stiffness", .value = 2.5, .range = {0.0, 9.0}, .what = "how stiff"}}});
    return true;
  }();
  EXPECT_TRUE(registered);
  return value;
}

TEST(OwnEngine, GetsItsSettingsFromTheConfig) {
  EXPECT_EQ(seen(), 0.0);
  small_problem(small_config({"engine=own"}));
  EXPECT_EQ(seen(), 2.5);
  const Config config = small_config({"engine=own", "engine_own.stiffness=4"});
  small_problem(config);
  EXPECT_EQ(seen(), 4.0);
  EXPECT_THAT(config.to_toml(), HasSubstr("stiffness = 4"));
  EXPECT_NE(config.identity(), small_config({"engine=own"}).identity());
}

TEST(OwnEngine, RefusesWhatItDoesNotKnow) {
  seen();
  EXPECT_THAT(tests::error_of([] {
                small_config({"engine=own", "engine_own.softness=1"});
              }),
              HasSubstr("softness"));
  EXPECT_THAT(tests::error_of([] {
                small_config({"engine=own", "engine_own.stiffness=10"});
              }),
              HasSubstr("expected a number from 0 to 9"));
  EXPECT_THAT(tests::error_of([] {
                small_config({"engine=batch", "engine_own.stiffness=1"});
              }),
              HasSubstr("engine_own"));
}

TEST(OwnEngine, IsInAChampionsFileWithItsSettings) {
  seen();
  Champion champion{.experiment = "test",
                    .problem = small_problem(small_config({"engine=own", "engine_own.stiffness=4"})),
                    .genome = {},
                    .result = {},
                    .trace = {},
                    .episodes = {}};
  champion.genome = small_population(champion.problem).genomes()[0];
  seen() = 0.0;
  const auto again = parse_champion(champion_text(champion), "c.json").champion;
  EXPECT_EQ(seen(), 4.0);
  EXPECT_EQ(again.problem.engine_own.numbers, champion.problem.engine_own.numbers);
}

TEST(OwnEngine, LeavesRecordsOfOtherEnginesAsTheyAre) {
  seen();
  EXPECT_EQ(small_config({"engine=batch"}).to_toml().find("engine_own"), std::string::npos);
  EXPECT_FALSE(problem_json(small_problem(small_config({"engine=batch"}))).contains("engine_own"));
}

}  // namespace
}  // namespace amble::experiment
