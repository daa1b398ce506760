#include "amble/study/planned_test.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <set>

#include "amble/experiment/config.hpp"
#include "amble/io/file.hpp"
#include "amble/study/plan.hpp"
#include "tests/io/expect_error.hpp"
#include "tests/study/fixture.hpp"

namespace amble::study {
namespace {

TEST(PlannedTest, IsTheSameOnlyIfNothingDiffersThatChangesItsTrials) {
  const PlannedTest test{.spec = trial_test("t", 10.0), .noise = {}};
  const std::string hash = test.settings_hash("batch");
  PlannedTest renamed = test, explicitly = test;
  renamed.spec.name = "u";
  explicitly.spec.engine = "batch";
  EXPECT_EQ(renamed.settings_hash("batch"), hash);
  EXPECT_EQ(explicitly.settings_hash("ode"), hash) << "the engine that the run has by itself";
  std::set<std::string> others{hash, test.settings_hash("ode")};
  EXPECT_EQ(others.size(), 2u);
  PlannedTest longer = test, more = test, noisy = test;
  longer.spec.seconds = 10.5;
  more.spec.episodes = 2;
  noisy.noise.push_m_s = 0.1;
  PlannedTest uneven = test, steeper = test;
  uneven.ground.emplace();
  steeper.ground.emplace().slope_x = 0.1;
  PlannedTest damaged = test, otherwise = test;
  damaged.damage.emplace().parts = {{.kind = damage::Kind::missing, .leg = "FL"}};
  otherwise.damage.emplace().parts = {{.kind = damage::Kind::missing, .leg = "FR"}};
  PlannedTest mutated = test, more_mutants = test;
  mutated.spec.mutants = 10;
  more_mutants.spec.mutants = 11;
  PlannedTest steered = test, harder = test, led = test, measured = test, jumping = test, scored = test;
  steered.steering.emplace().gains.turn_gain = 1.0;
  harder.steering.emplace().gains.turn_gain = 2.0;
  led.steering = steered.steering;
  led.steering->heading.lead_rad = 1.0;
  measured.spec.energy = true;
  jumping.spec.seam = true;
  scored.spec.score = true;
  PlannedTest quick = test, quicker = test;
  quick.engine_own.numbers["quick_sweeps"] = 20;
  quicker.engine_own.numbers["quick_sweeps"] = 10;
  for (const PlannedTest& other :
       {longer, more, noisy, uneven, steeper, damaged, otherwise, mutated, more_mutants, steered, harder, led,
        measured, jumping, scored, quick, quicker})
    EXPECT_TRUE(others.insert(other.settings_hash("batch")).second);
}

TEST(PlannedTest, UnderNoiseHasNoEpisodeWithoutIt) {
  const test::TemporaryFolder folder;
  const auto config = folder.put("noise.toml", "include = [\"" + config_file("robust/supg-objective") +
                                                   "\"]\n[noise]\nfirst_undisturbed = true\n");
  ASSERT_TRUE(experiment::load_config(config, {}).noise.first_undisturbed);
  auto study = small_study();
  study.tests = {trial_test("noisy", 2.0, config, 3)};
  const Plan plan = make_plan(study, "out");
  EXPECT_FALSE(plan.conditions[0].tests.at(0).noise.first_undisturbed);
}

TEST(PlannedTest, OfEpisodesThatWouldAllBeTheSameTrialIsRefused) {
  const test::TemporaryFolder folder;
  const auto plan_with = [&](double start_place_m, const std::string& noise, int episodes) {
    const auto file = folder.path() / "ground.toml";
    io::write_file(file, fmt::format("include = [\"{}\"]\n[ground]\nkind = \"stones\"\nstart_place_m = {}\n",
                                     config_file("authors/sine-objective"), start_place_m));
    auto study = small_study();
    study.tests = {trial_test("t", 1.0, noise, episodes)};
    study.tests[0].ground = file.string();
    return make_plan(study, "nowhere");
  };
  const auto error = test::error_of(ExitCode::bad_input, [&] { plan_with(0.0, "", 3); });
  EXPECT_NE(error.find("'tests[0].episodes' = 3"), std::string::npos) << error;
  EXPECT_NO_THROW(plan_with(0.0, "", 1));
  EXPECT_NO_THROW(plan_with(2.0, "", 3));
  EXPECT_NO_THROW(plan_with(0.0, config_file("robust/supg-objective"), 3));
}

TEST(PlannedTest, AMistakeInAFileThatItNamesIsToldWithBothPlaces) {
  const test::TemporaryFolder folder;
  const std::string file = (folder / "damage.toml").string();
  auto study = small_study();
  study.where = [](const std::string& key) { return "s.toml, at " + key; };
  study.tests = {trial_test("hurt", 1.0)};
  study.tests[0].damage = file;
  const auto refusal = [&] { return test::error_of(ExitCode::bad_input, [&] { plan_test(study, 0); }); };
  io::write_file(file, "[damage]\nkind = \"none\"\n");
  EXPECT_THAT(refusal(), testing::StartsWith("s.toml, at tests[0].damage: 'tests[0].damage': " + file +
                                             ":2: unknown key 'damage.kind'"));
  io::write_file(file, "[damage]\n");
  EXPECT_THAT(refusal(), testing::EndsWith("expected the path of a robot file, as in a config that may "
                                           "include this one"));
}

TEST(PlannedTest, HasNoDamageThatBeginsWhenItHasEnded) {
  const test::TemporaryFolder folder;
  const std::string file = (folder / "damage.toml").string();
  auto study = small_study();
  study.tests = {trial_test("hurt", 1.0)};
  study.tests[0].damage = file;
  io::write_file(file,
                 "robot = \"x.toml\"\ndamage.parts = [{kind = \"missing\", leg = \"FL\", from_s = 0.5}]\n");
  EXPECT_NO_THROW(plan_test(study, 0));
  io::write_file(file,
                 "robot = \"x.toml\"\ndamage.parts = [{kind = \"missing\", leg = \"FL\", from_s = 2}]\n");
  EXPECT_THAT(test::error_of(ExitCode::bad_input, [&] { plan_test(study, 0); }),
              testing::HasSubstr("damage.parts[0].from_s = 2: the trial is 1 s long, and has ended by then"));
}

TEST(PlannedTest, HasTheSettingsOfItsEngine) {
  auto study = small_study();
  study.tests = {trial_test("quick", 1.0)};
  study.tests[0].engine = "ode-variant";
  study.tests[0].engine_own = {"quick_sweeps=20", "friction_n=5e1"};
  const PlannedTest test = plan_test(study, 0);
  EXPECT_EQ(test.engine_own.numbers,
            (std::map<std::string, double>{{"quick_sweeps", 20}, {"friction_n", 50}}));
  const Plan plan = make_plan(study, "nowhere");
  const auto& condition = plan.conditions[0];
  const auto problem =
      condition.tests.at(0).problem(experiment::Problem::make(condition.config, condition.robot));
  EXPECT_EQ(problem.engine, "ode-variant");
  EXPECT_EQ(problem.engine_own.numbers, test.engine_own.numbers);
}

TEST(PlannedTest, OfSettingsThatItsEngineHasNotIsRefused) {
  const auto refusal = [](const std::string& engine, const std::string& assignment) {
    auto study = small_study();
    study.tests = {trial_test("t", 1.0)};
    study.tests[0].engine = engine;
    study.tests[0].engine_own = {assignment};
    return test::error_of(ExitCode::bad_input, [&] { plan_test(study, 0); });
  };
  EXPECT_THAT(refusal("ode", "quick_sweeps=20"),
              testing::HasSubstr("'tests[0].engine_own': the engine \"ode\" has no setting 'quick_sweeps'"));
  EXPECT_THAT(refusal("", "quick_sweeps=20"),
              testing::HasSubstr("the test names no engine; expected 'engine' beside it"));
  EXPECT_THAT(refusal("ode-variant", "sweeps=20"), testing::HasSubstr("has no setting 'sweeps'"));
  for (const std::string assignment : {"quick_sweeps", "quick_sweeps=", "quick_sweeps=many",
                                       "quick_sweeps=-1", "quick_sweeps=nan", "quick_sweeps=20 "})
    EXPECT_THAT(
        refusal("ode-variant", assignment),
        testing::HasSubstr("has \"" + assignment + "\": expected quick_sweeps=NUMBER from 0 to 10000"));
}

}  // namespace
}  // namespace amble::study
