#include "amble/study/plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <algorithm>
#include <atomic>
#include <filesystem>
#include <set>
#include <thread>

#include "amble/experiment/problem.hpp"
#include "amble/experiment/run.hpp"
#include "amble/io/file.hpp"
#include "amble/io/json_file.hpp"
#include "amble/study/doubts.hpp"
#include "tests/io/expect_error.hpp"
#include "tests/study/fixture.hpp"

namespace amble::study {
namespace {

using Runs = std::vector<std::pair<std::size_t, std::int64_t>>;

Runs runs_of(const Plan& plan) {
  Runs runs;
  for (const PlannedRun& run : plan.runs) runs.emplace_back(run.condition, run.seed);
  return runs;
}

ledger::StudySpec three_conditions() {
  auto study = small_study();
  study.seeds = {11, 12, 13};
  study.conditions = {condition("a", "authors/sine-objective"), condition("b", "authors/supg-objective"),
                      condition("c", "authors/sine-objective")};
  study.conditions[2].seeds = {7};
  return study;
}

TEST(Plan, GoesSeedBySeedThroughTheConditionsAndBeginsEachWithAnother) {
  const Plan plan = make_plan(three_conditions(), "out");
  EXPECT_EQ(runs_of(plan), (Runs{{0, 11}, {1, 11}, {2, 7}, {1, 12}, {0, 12}, {0, 13}, {1, 13}}));
}

TEST(Plan, IsDividedByItsShardsWithoutGapOrOverlap) {
  const Plan plan = make_plan(three_conditions(), "out");
  EXPECT_EQ(plan.shard({2, 3}), (std::vector<std::size_t>{1, 4}));
  for (int count = 1; count <= 8; ++count) {
    std::vector<std::size_t> all;
    for (int index = 1; index <= count; ++index)
      for (const std::size_t run : plan.shard({index, count})) all.push_back(run);
    std::ranges::sort(all);
    EXPECT_EQ(all, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6})) << count;
  }
}

TEST(Plan, NamesAFileOfTheStudyThatIsNotThereAndWhereToLook) {
  auto study = three_conditions();
  study.tests = {trial_test("rough", 1.0)};
  study.where = [](const std::string& key) { return "s.toml:7 for " + key; };
  const auto refusal = [&] { return test::error_of(ExitCode::bad_input, [&] { make_plan(study, "out"); }); };
  study.tests[0].ground = "a/../none.toml";
  EXPECT_EQ(refusal(),
            "s.toml:7 for tests[0].ground: 'tests[0].ground' = \"none.toml\": no such file; the head of the "
            "study may say how it is made");
  study.conditions[1].robot = "gone.json";
  EXPECT_THAT(refusal(), testing::StartsWith("s.toml:7 for conditions[1].robot: "));
}

TEST(Shard, IsWrittenAsItsIndexFromOneAndTheirCount) {
  EXPECT_EQ(Shard::parse("2/8").index, 2);
  EXPECT_EQ(Shard::parse("2/8").count, 8);
  EXPECT_EQ(Shard::parse("8/8").index, 8);
  for (const char* text : {"0/8", "9/8", "-1/8", "2", "2/", "/8", "2/8x", "2 /8", "", "1/0"})
    EXPECT_THROW(Shard::parse(text), UserError) << text;
}

TEST(Plan, TakesAConditionsOwnGenerationsAndSettingsBeforeTheStudys) {
  auto study = small_study();
  study.conditions.push_back(study.conditions[0]);
  study.conditions[1].name = "other";
  study.conditions[1].generations = 9;
  study.conditions[1].settings = {"population.size=44"};
  const Plan plan = make_plan(study, "out");
  EXPECT_EQ(plan.conditions[0].config.generations, 5);
  EXPECT_EQ(plan.conditions[0].config.neat.population.size, 20);
  EXPECT_EQ(plan.conditions[1].config.generations, 9);
  EXPECT_EQ(plan.conditions[1].config.neat.population.size, 44);
  EXPECT_EQ(plan.config({1, 17}).seed, 17);
}

TEST(ConfigHash, IsOfAllThatMakesARunButItsSeedLengthAndName) {
  const auto robot_file = std::string(AMBLE_SOURCE_DIR) + "/robots/quadruped/paper.toml";
  const auto hash_with = [](const std::vector<std::string>& settings, int generations = 4) {
    const auto config =
        experiment::load_config(config_file("authors/sine-objective"),
                                {.assignments = settings, .seed = 1, .generations = generations});
    return config_hash(config, experiment::load_robot(config));
  };
  const std::string hash = hash_with({});
  EXPECT_EQ(hash_with({"name=other"}), hash);
  EXPECT_EQ(hash_with({"seed=5"}), hash);
  EXPECT_EQ(hash_with({}, 5), hash);
  std::set<std::string> others{hash};
  for (const std::string setting :
       {"population.size=301", "trial.duration_s=14", "engine=batch", "noise.push_m_s=0.1",
        "search.kind=novelty", "speciation.first_step_up=0.4", "score.terms=[{quantity=\"forward\"}]"})
    EXPECT_TRUE(others.insert(hash_with({setting})).second) << setting;
  EXPECT_TRUE(others.insert(hash_with({"robot=\"" + robot_file + "\""})).second);
}

TEST(Plan, AConditionSwitchesBetweenTheElitesOfAMapAloneAndItsRecordsAreNoOthers) {
  auto study = small_study();
  study.conditions = {condition("best", "repertoire/quadruped"), condition("switching", "steer/map")};
  study.conditions[0].config = study.conditions[1].config;
  study.conditions[1].gaits = 4;
  const Plan plan = make_plan(study, "out");
  EXPECT_EQ(plan.conditions[0].hash, plan.conditions[1].hash) << "the runs are the same";
  EXPECT_EQ(plan.conditions[0].recorded_hash(), plan.conditions[0].hash);
  EXPECT_NE(plan.conditions[1].recorded_hash(), plan.conditions[1].hash);
}

TEST(Plan, AConditionThatSwitchesIsRefusedWhereItsRunsMakeNoMapThatItCould) {
  const auto refusal = [](const std::string& config, std::vector<std::string> settings) {
    auto study = small_study();
    study.where = [](const std::string& key) { return "s.toml, at " + key; };
    study.conditions = {condition("switching", config)};
    study.conditions[0].gaits = 4;
    study.conditions[0].settings = std::move(settings);
    return test::error_of(ExitCode::bad_input, [&] { make_plan(study, "out"); });
  };
  const std::string place = "s.toml, at conditions[0].gaits: condition 'switching': gaits = 4: ";
  EXPECT_THAT(refusal("authors/supg-objective", {}),
              testing::StartsWith(place + "the config has search.kind = \"objective\""));
  EXPECT_THAT(refusal("repertoire/quadruped", {}),
              testing::AllOf(testing::StartsWith(place), testing::HasSubstr("no dimension own_speed")));
  EXPECT_THAT(refusal("authors/ctrnn-objective",
                      {"search.kind=map-elites",
                       "search.map_elites.descriptors=[{quantity=\"own_speed\"}, {quantity=\"yaw_rate\"}]"}),
              testing::AllOf(testing::StartsWith(place), testing::HasSubstr("of kind \"ctrnn\"")));
}

TEST(Plan, ATestUnderOwnNoiseHasThatOfEachConditionAndIsRefusedWhereThereIsNone) {
  auto study = small_study();
  study.conditions = {condition("robust", "robust/supg-objective"), condition("quick", "quick/supg")};
  study.tests = {trial_test("own", 2.0)};
  study.tests[0].level = "own";
  study.tests[0].episodes = 3;
  const Plan plan = make_plan(study, "out");
  const PlannedTest &robust = plan.conditions[0].tests.at(0), &quick = plan.conditions[1].tests.at(0);
  EXPECT_TRUE(robust.noise.any());
  EXPECT_FALSE(robust.noise.first_undisturbed);
  EXPECT_EQ(io::settings_to_json(quick.noise), io::settings_to_json([&] {
              auto noise = plan.conditions[1].config.noise;
              noise.first_undisturbed = false;
              return noise;
            }()));
  EXPECT_NE(robust.settings_hash("batch"), "");
  study.conditions.push_back(condition("exact", "authors/supg-objective"));
  try {
    make_plan(study, "out");
    FAIL() << "accepted";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("condition 'exact': test 'own' has level = \"own\""));
  }
}

TEST(Plan, AMistakeInAStudysSettingsIsNamedWithItsPlaceInTheStudy) {
  const auto refusal = [](std::vector<std::string> all, std::vector<std::string> own) {
    auto study = small_study();
    study.conditions = {condition("a", "robust/supg-objective")};
    study.settings = std::move(all);
    study.conditions[0].settings = std::move(own);
    study.where = [](const std::string& key) { return "s.toml, at " + key; };
    try {
      make_plan(study, "out");
    } catch (const UserError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal({}, {"population.sise=10"}),
              testing::StartsWith(
                  "s.toml, at conditions[0].settings: condition 'a': the setting population.sise=10"));
  EXPECT_THAT(refusal({"population.sise=10"}, {"seed=3"}),
              testing::StartsWith("s.toml, at settings: condition 'a': the setting population.sise=10"));
  EXPECT_THAT(refusal({}, {"seed=3"}),
              testing::StartsWith("s.toml, at conditions[0].settings: condition 'a': the setting seed=3: "));
  EXPECT_THAT(refusal({"generations=3"}, {}),
              testing::StartsWith("s.toml, at settings: condition 'a': the setting generations=3: "));
  EXPECT_THAT(refusal({}, {"search.kind=hope"}),
              testing::StartsWith("s.toml, at conditions[0].settings: condition 'a': "));
}

TEST(Plan, ATestThatLooksThroughARunsChampionsIsRefusedWhereTheyDoNotSwitchAsTheWalkerDoes) {
  auto study = small_study();
  study.conditions = {condition("best", "repertoire/quadruped"), condition("switching", "steer/map")};
  study.conditions[1].gaits = 4;
  study.tests = {trial_test("walk", 2.0)};
  study.tests[0].reach_m = 1.0;
  study.tests[0].conditions = {"best"};
  EXPECT_EQ(make_plan(study, "out").conditions[0].tests.size(), 1U);
  study.tests[0].conditions = {};
  try {
    make_plan(study, "out");
    FAIL() << "accepted";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(),
                testing::HasSubstr("condition 'switching': gaits = 4: test 'walk' has reach_m"));
  }
}

TEST(Plan, ChampionsOfAConditionThatIsSteeredAreSoInTestsWithACommandAlone) {
  auto study = small_study();
  study.conditions = {condition("hand", "authors/supg-objective"),
                      condition("bare", "authors/supg-objective")};
  study.conditions[0].steering = "turn_gain = 1.5, full_speed_m_s = 0.4";
  study.tests = {trial_test("told", 2.0), trial_test("free", 2.0)};
  study.tests[0].command = "0.4,0; 0.4,0.5";
  const Plan plan = make_plan(study, "out");
  ASSERT_TRUE(plan.conditions[0].tests[0].steering);
  EXPECT_EQ(plan.conditions[0].tests[0].steering->gains.turn_gain, 1.5);
  EXPECT_FALSE(plan.conditions[0].tests[1].steering);
  EXPECT_FALSE(plan.conditions[1].tests[0].steering);
  const auto refused = [&](const std::string& steering) -> std::string {
    study.conditions[0].steering = steering;
    try {
      make_plan(study, "out");
    } catch (const UserError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_THAT(refused("heading_gain = 0"), testing::HasSubstr("steers nothing"));
  EXPECT_THAT(refused("turn_gan = 1"), testing::HasSubstr("turn_gain"));
  EXPECT_THAT(refused("turn_gain = 1, joint_types = [\"toe\"]"), testing::HasSubstr("no joint type toe"));
  study.where = [](const std::string& key) { return "s.toml:" + key; };
  EXPECT_THAT(
      refused("foo = 1"),
      testing::StartsWith("s.toml:conditions[0].steering: condition 'hand': steering: unknown key 'foo'"));
  EXPECT_THAT(refused("turn_gain = 1, joint_types = [\"toe\"]"),
              testing::StartsWith("s.toml:conditions[0].steering: condition 'hand': "));
}

TEST(Plan, ATestWithDamageIsRefusedWhereNeitherItNorTheConditionHasAny) {
  const test::TemporaryFolder folder;
  auto study = small_study();
  study.tests = {trial_test("hurt", 1.0)};
  study.tests[0].damage = config_file("authors/sine-objective");
  EXPECT_THAT(test::error_of(ExitCode::bad_input, [&] { make_plan(study, folder.path()); }),
              testing::HasSubstr("a config without [damage]"));
  study.settings.emplace_back("damage.parts=[{kind='missing', leg='FL'}]");
  EXPECT_NO_THROW(make_plan(study, folder.path())) << "it is tested intact";
}

TEST(PlanDoubts, AreConditionsThatAreTheSameAndClaimsOnScoresThatDiffer) {
  const test::TemporaryFolder folder;
  auto study = small_study();
  study.conditions.push_back(study.conditions[0]);
  study.conditions[1].name = "other";
  ledger::ClaimSpec claim;
  claim.text = "one is more";
  claim.condition = study.conditions[0].name;
  claim.against = "other";
  study.claims = {claim};
  using testing::ElementsAre;
  using testing::HasSubstr;
  EXPECT_THAT(doubts_of(make_plan(study, folder.path())), ElementsAre(HasSubstr("have the same settings")));
  study.conditions[1].settings = {"score.terms=[{quantity='forward'}]"};
  EXPECT_THAT(doubts_of(make_plan(study, folder.path())),
              ElementsAre(HasSubstr("evolve by different scores")));
  study.conditions[1].settings = {"noise.push_m_s=0.1"};
  EXPECT_THAT(doubts_of(make_plan(study, folder.path())), testing::IsEmpty());
}

TEST(Plan, RefusesAClaimOnWhatRunsOfAConditionNeverHave) {
  auto study = small_study();
  study.conditions = {condition("jumps", "authors/supg-objective"),
                      condition("turns", "authors/ctrnn-objective")};
  study.tests = {trial_test("walk", 2.0)};
  study.tests[0].seam = true;
  auto& claim = study.claims.emplace_back();
  claim.text = "They jump less.";
  claim.measure = "walk.jump_rad";
  claim.condition = "jumps";
  EXPECT_NO_THROW(make_plan(study, "out"));
  claim.against = "turns";
  try {
    make_plan(study, "out");
    ADD_FAILURE() << "accepted";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(),
                testing::StartsWith("'claims[0].measure' = \"walk.jump_rad\": the controller of "
                                    "condition 'turns' is of kind ctrnn, which has no cycles"));
  }
  study.claims[0].measure = "walk.distance_m";
  EXPECT_NO_THROW(make_plan(study, "out"));
  study.claims[0].measure = "coverage";
  try {
    make_plan(study, "out");
    ADD_FAILURE() << "accepted";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(),
                testing::HasSubstr("the search of condition 'jumps' is of kind objective, which "
                                   "fills no map"));
  }
  study.claims[0].measure = "walk.moving_s";
  study.tests[0].seconds = 9.0;
  EXPECT_THROW(make_plan(study, "out"), UserError);
  study.tests[0].seconds = 10.0;
  EXPECT_NO_THROW(make_plan(study, "out"));
  study.claims[0].measure = "walk.kept";
  EXPECT_NO_THROW(make_plan(study, "out"));
  study.settings.emplace_back("score.terms=[{quantity='uprightness'}]");
  EXPECT_THROW(make_plan(study, "out"), UserError);
}

TEST(Plan, RefusesTestsThatNoChampionCouldBePutTo) {
  auto study = small_study();
  const auto refusal = [&] {
    try {
      make_plan(study, "nowhere");
    } catch (const UserError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  study.where = [](const std::string& key) { return "s.toml, at " + key; };
  study.tests = {trial_test("odd", 0.004)};
  EXPECT_THAT(refusal(),
              testing::StartsWith("s.toml, at tests[0].seconds: condition 'sine': test 'odd': "
                                  "trial.duration_s = 0.004: expected a whole number of timesteps"));

  const test::TemporaryFolder folder;
  io::write_file(folder / "ground.toml", fmt::format("include = [\"{}\"]\n[ground]\nkind = \"stones\"\n",
                                                     config_file("authors/sine-objective")));
  study.tests = {trial_test("rough", 1.0)};
  study.tests[0].ground = (folder / "ground.toml").string();
  study.settings.push_back("ground.friction=0.7");
  EXPECT_THAT(refusal(), testing::StartsWith("s.toml, at tests[0].ground: condition 'sine': test 'rough': "
                                             "ground.friction = -1"));
}

TEST(Plan, CanBeMadeOfEveryStudyInTheFolder) {
  int studies = 0;
  for (const auto& file : std::filesystem::directory_iterator(AMBLE_SOURCE_DIR "/studies")) {
    if (file.path().extension() != ".toml") continue;
    const Plan plan = make_plan(ledger::load_study(file.path()), "nowhere");
    EXPECT_FALSE(plan.runs.empty()) << file.path();
    ++studies;
  }
  EXPECT_GE(studies, 9);
}

using testing::HasSubstr;

class Fit : public testing::Test {
 protected:
  Fit() { study_.tests = {trial_test("brief", 1.0)}; }

  std::vector<RunStatus> states(const ledger::StudySpec& study) const {
    return survey(make_plan(study, folder_.path()));
  }
  /// What survey() refuses the folder with.
  std::string refusal(const ledger::StudySpec& study) const {
    try {
      states(study);
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_input);
      return error.what();
    }
    return "";
  }
  void finish_all() {
    Notes notes;
    work_on(study_, folder_.path(), notes, true);
  }
  void begin() {
    const Plan plan = make_plan(study_, folder_.path());
    std::filesystem::create_directories(plan.paths.runs);
    experiment::Run::start(plan.folder(plan.runs[0]), plan.config(plan.runs[0]), 1);
  }

  const test::TemporaryFolder folder_;
  ledger::StudySpec study_ = small_study();
};

using States = std::vector<RunStatus>;

TEST_F(Fit, IsFoundWhileAnotherProcessFinishesRunsAndRemovesTheirFolders) {
  study_.seeds.clear();
  for (int seed = 1; seed <= 12; ++seed) study_.seeds.push_back(seed);
  study_.generations = 1;
  std::atomic<bool> finished{false};
  std::thread other([&] {
    finish_all();
    finished = true;
  });
  while (!finished) EXPECT_NO_THROW(states(study_));
  other.join();
  EXPECT_EQ(states(study_), States(12, RunStatus::done));
}

TEST_F(Fit, RunsAreMissingBegunUntestedOrDone) {
  study_.seeds = {3, 4};
  EXPECT_EQ(states(study_), (States{RunStatus::missing, RunStatus::missing}));
  begin();
  EXPECT_EQ(states(study_), (States{RunStatus::begun, RunStatus::missing}));
  finish_all();
  EXPECT_EQ(states(study_), (States{RunStatus::done, RunStatus::done}));
  study_.tests.push_back(trial_test("another", 1.0));
  study_.tests.back().conditions = {"sine"};
  EXPECT_EQ(states(study_), (States{RunStatus::untested, RunStatus::untested}));
  study_.seeds = {4, 5};
  EXPECT_EQ(states(study_), (States{RunStatus::untested, RunStatus::missing}));
}

/// All that makes a finished or begun run another one.
void expect_refusals(const std::function<std::string(const ledger::StudySpec&)>& refusal,
                     const ledger::StudySpec& study) {
  EXPECT_EQ(refusal(study), "");
  for (const int generations : {4, 6}) {
    auto changed = study;
    changed.generations = generations;
    EXPECT_THAT(refusal(changed), HasSubstr("(5 generations instead of " + std::to_string(generations)));
  }
  auto changed = study;
  changed.settings.push_back("mutation.add_node_share=0.02");
  EXPECT_THAT(refusal(changed), HasSubstr("made with other settings or another robot"));
}

TEST_F(Fit, ARecordOfAnotherStudyIsRefused) {
  finish_all();
  expect_refusals([this](const auto& study) { return refusal(study); }, study_);
  auto changed = study_;
  changed.tests[0].seconds = 2.0;
  EXPECT_THAT(refusal(changed), HasSubstr("(the test 'brief' was another one)"));
}

TEST_F(Fit, ABegunRunOfAnotherStudyIsRefused) {
  begin();
  expect_refusals([this](const auto& study) { return refusal(study); }, study_);
  const ledger::StudyPaths paths(folder_.path());
  std::filesystem::rename(paths.run("sine", 3), paths.run("sine", 4));
  study_.seeds = {4};
  EXPECT_THAT(refusal(study_), HasSubstr("sine-004 in " + paths.runs.string() + " (has the seed 3)"));
}

TEST_F(Fit, ARefusalNamesAllRunsThatDoNotFitAndWhy) {
  study_.conditions.push_back(condition("wave", "authors/sine-objective"));
  study_.seeds = {5, 9, 3, 4, 8};
  finish_all();
  study_.seeds = {11};
  begin();
  study_.seeds = {5, 9, 3, 4, 8, 11};
  study_.generations = 6;
  study_.conditions[1].settings = {"mutation.add_node_share=0.02"};
  const ledger::StudyPaths paths(folder_.path());
  EXPECT_EQ(
      refusal(study_),
      fmt::format(
          "11 of 12 runs no longer fit the study: "
          "sine-003 to sine-005, sine-008, sine-009 in {0} (5 generations instead of 6); "
          "wave-003 to wave-005, wave-008, wave-009 in {0} (made with other settings or another robot); "
          "sine-011 in {1} (5 generations instead of 6); "
          "nothing was changed; name another --out, or move them away",
          paths.records.string(), paths.runs.string()));
}

}  // namespace

}  // namespace amble::study
