#include "amble/study/worker.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <thread>

#include "amble/experiment/corrected_map.hpp"
#include "amble/experiment/run.hpp"
#include "amble/io/file.hpp"
#include "amble/io/lock.hpp"
#include "amble/ledger/measures.hpp"
#include "amble/record/generations_csv.hpp"
#include "amble/study/champion_tests.hpp"
#include "tests/core/error_of.hpp"
#include "tests/study/fixture.hpp"

namespace amble::study {
namespace {

TEST(Worker, RecordsWhatTheRunSays) {
  const test::TemporaryFolder folder;
  Notes notes;
  const auto result = work_on(small_study(), folder.path(), notes);
  EXPECT_EQ(result.finished, 1);
  EXPECT_EQ(notes.started, 1);
  EXPECT_EQ(notes.generations, 5);
  ASSERT_EQ(notes.records.size(), 1u);
  const ledger::Record& record = notes.records[0];
  EXPECT_EQ(record.condition, "sine");
  EXPECT_EQ(record.seed, 3);
  EXPECT_EQ(record.generations, 5);
  EXPECT_EQ(record.evaluations, 5u * 20u);

  const auto rows =
      record::read_generations(ledger::StudyPaths(folder.path()).run("sine", 3) / "generations.csv");
  ASSERT_EQ(rows.count(), 5u);
  double steps = 0.0;
  for (const double of_generation : rows.steps) steps += of_generation;
  EXPECT_EQ(static_cast<double>(record.steps), steps);
  // The curve has the generations that were better than all before, and no other.
  std::vector<ledger::CurvePoint> expected;
  for (std::size_t i = 0; i < rows.count(); ++i) {
    bool better = true;
    for (std::size_t earlier = 0; earlier < i; ++earlier) better &= rows.best[i] > rows.best[earlier];
    if (better) expected.push_back({static_cast<int>(i), rows.best[i]});
  }
  EXPECT_EQ(record.curve, expected);
  EXPECT_LT(expected.size(), rows.count()) << "some generation only equals the best";
  EXPECT_EQ(record.best_objective, expected.back().best_objective);
  EXPECT_EQ(record.best_generation, expected.back().generation);
  const auto champion = champion_from_json(record.champion, "record");
  EXPECT_EQ(champion.result.distance_m, record.best_objective);
  EXPECT_EQ(champion.genome.count(neat::NodeKind::hidden), record.hidden);
  EXPECT_EQ(champion.genome.enabled_links(), record.links);
}

TEST(Worker, FindsTheFirstBestThatGetsAsFarAsATestAsks) {
  const test::TemporaryFolder folder;
  auto study = small_study();
  Notes first, looking;
  work_on(study, folder.path(), first);
  const auto& curve = first.records.at(0).curve;
  ASSERT_GE(curve.size(), 3u);
  // In the run's own trial a champion gets as far as in its evolution: the curve says which one is the first.
  study.tests = {trial_test("middle", 1.0), trial_test("beyond", 1.0), trial_test("plain", 1.0)};
  study.tests[0].reach_m = 0.5 * (curve[0].best_objective + curve[1].best_objective);
  study.tests[1].reach_m = curve.back().best_objective + 0.001;
  EXPECT_EQ(work_on(study, folder.path(), looking).finished, 1);
  const ledger::Record& record = looking.records.at(0);
  const auto rows =
      record::read_generations(ledger::StudyPaths(folder.path()).run("sine", 3) / "generations.csv");
  double steps = 0.0, wall_s = 0.0;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(curve[1].generation); ++i) {
    steps += rows.steps[i];
    wall_s += rows.wall_s[i];
  }
  const auto& reached = record.tests.at(0).reached;
  ASSERT_TRUE(reached);
  EXPECT_EQ(reached->generation, curve[1].generation);
  EXPECT_EQ(reached->evaluations, 20u * static_cast<unsigned>(curve[1].generation + 1));
  EXPECT_EQ(static_cast<double>(reached->steps), steps);
  EXPECT_FALSE(record.tests.at(1).reached);
  EXPECT_FALSE(record.tests.at(2).reached);
  EXPECT_EQ(ledger::measure(record, "middle.reached_s"), wall_s);
  EXPECT_EQ(ledger::measure(record, "middle.reached_generation"), 1.0 * curve[1].generation);
  EXPECT_EQ(ledger::measure(record, "beyond.reached_evaluations"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(ledger::measure(record, "plain.reached_s"), std::nullopt);
  const auto& paths = ledger::StudyPaths(folder.path());
  EXPECT_EQ(ledger::record_text(ledger::Ledger(paths).load("sine", 3)), ledger::record_text(record));
}

TEST(Worker, RecordsWhatAMapReached) {
  const test::TemporaryFolder folder;
  auto study = small_study({"search.map_elites.batch=64", "search.map_elites.initial=64"});
  study.conditions = {condition("map", "repertoire/quadruped"), condition("sine", "authors/sine-objective")};
  study.settings = {"engine=batch", "population.size=20", "trial.duration_s=1", "search.map_elites.batch=64",
                    "search.map_elites.initial=64"};
  Notes notes;
  work_on(study, folder.path(), notes);
  ASSERT_EQ(notes.records.size(), 2u);
  const auto& record = notes.records[notes.records[0].condition == "map" ? 0 : 1];
  const auto& plain = notes.records[notes.records[0].condition == "map" ? 1 : 0];
  const auto rows =
      record::read_generations(ledger::StudyPaths(folder.path()).run("map", 3) / "generations.csv");
  EXPECT_EQ(ledger::measure(record, "coverage"), rows.coverage.back());
  EXPECT_EQ(ledger::measure(record, "qd_score"), rows.qd_score.back());
  EXPECT_EQ(ledger::measure(record, "map_best"), rows.map_best.back());
  double entering = 0.0, again = 0.0;
  for (std::size_t i = 0; i < rows.count(); ++i)
    entering += rows.entered[i] + rows.improved[i], again += rows.reevaluated[i];
  EXPECT_GT(again, 0.0);
  EXPECT_EQ(ledger::measure(record, "entering_share"),
            entering / (static_cast<double>(record.evaluations) - again));
  EXPECT_EQ(ledger::measure(plain, "coverage"), std::nullopt);
  EXPECT_EQ(ledger::measure(record, "staying_share"), std::nullopt) << "the study does not ask for it";
  const ledger::Ledger kept(ledger::StudyPaths(folder.path()));
  EXPECT_EQ(kept.load("map", 3).map_figures, record.map_figures);
}

TEST(Worker, RecordsWhatAMapKeepsInNewTrialsIfTheStudyAsks) {
  const test::TemporaryFolder folder;
  auto study = small_study({"search.map_elites.batch=64", "search.map_elites.initial=64"});
  study.conditions = {condition("map", "repertoire/quadruped"), condition("sine", "authors/sine-objective")};
  study.settings = {"engine=batch", "population.size=20", "trial.duration_s=1", "search.map_elites.batch=64",
                    "search.map_elites.initial=64"};
  study.map_trials = 3;
  Notes notes;
  work_on(study, folder.path(), notes);
  const auto& record = notes.records[notes.records[0].condition == "map" ? 0 : 1];
  const auto& plain = notes.records[notes.records[0].condition == "map" ? 1 : 0];
  const experiment::RunPaths run(ledger::StudyPaths(folder.path()).run("map", 3));
  const std::atomic<bool> stop = false;
  const auto corrected = experiment::correct_map(experiment::load_repertoire(run), 3, 1, stop).value();
  EXPECT_EQ(ledger::measure(record, "corrected_coverage"), corrected.coverage());
  EXPECT_EQ(ledger::measure(record, "corrected_qd_score"), corrected.qd_score());
  EXPECT_EQ(ledger::measure(record, "staying_share"), corrected.staying_share());
  EXPECT_EQ(ledger::measure(plain, "staying_share"), std::nullopt) << "it has no map";
  const ledger::Ledger kept(ledger::StudyPaths(folder.path()));
  EXPECT_EQ(kept.load("map", 3).map_figures, record.map_figures);
  EXPECT_EQ(kept.load("map", 3).map_trials, 3);
  study.map_trials = 2;
  EXPECT_THAT(tests::error_of([&] { survey(make_plan(study, folder.path())); }),
              testing::HasSubstr("its map was tried again with map_trials = 3 instead of 2"));
  EXPECT_EQ(plain.map_trials, 0);
}

/// The distance is the score in these studies: that of which mutants keep shares must be the mean of the
/// champion's own trials.
void expect_mutants_beside_their_champion(const ledger::TestSpec& spec) {
  const test::TemporaryFolder folder;
  auto study = small_study();
  Notes first, adding;
  work_on(study, folder.path(), first, true);
  study.tests = {spec};
  study.tests[0].mutants = 12;
  ASSERT_EQ(work_on(study, folder.path(), adding).finished, 1);
  const auto record = ledger::Ledger(ledger::StudyPaths(folder.path())).load("sine", 3);
  const ledger::TestResult& result = record.tests.at(0);
  double mean_m = 0.0;
  for (const auto& episode : result.episodes)
    mean_m += episode.distance_m / static_cast<double>(result.episodes.size());
  EXPECT_GT(mean_m, 0.0);
  EXPECT_NEAR(result.champion_score, mean_m, 1e-9);
  ASSERT_EQ(result.mutants.size(), 12u);
  std::set<double> kept;
  for (const record::Mutant& mutant : result.mutants) {
    EXPECT_NEAR(1000.0 * mutant.kept, std::round(1000.0 * mutant.kept), 1e-9);
    kept.insert(mutant.kept);
  }
  EXPECT_GT(kept.size(), 6u);
}

TEST(Worker, TriesMutantsInTheTrialsOfTheirChampion) {
  expect_mutants_beside_their_champion(trial_test("plain", 2.0));
  expect_mutants_beside_their_champion(trial_test("noisy", 2.0, config_file("robust/supg-objective"), 3));
  auto damaged = trial_test("damaged", 2.0), uneven = trial_test("uneven", 2.0);
  const test::TemporaryFolder folder;
  io::write_file(
      folder.path() / "damage.toml",
      fmt::format("include = [\"{}\"]\n[damage]\nparts = [{{ kind = \"missing\", leg = \"FL\" }}]\n",
                  config_file("authors/sine-objective")));
  damaged.damage = (folder.path() / "damage.toml").string();
  expect_mutants_beside_their_champion(damaged);
  io::write_file(
      folder.path() / "ground.toml",
      fmt::format("include = [\"{}\"]\n[ground]\nkind = \"stones\"\nheight_m = 0.1\nstart_place_m = 2\n",
                  config_file("authors/sine-objective")));
  uneven.ground = (folder.path() / "ground.toml").string();
  uneven.episodes = 3;
  expect_mutants_beside_their_champion(uneven);
}

TEST(Worker, SaysThatItNeedsTheRunToFindItsFirstWalker) {
  const test::TemporaryFolder folder;
  auto study = small_study();
  Notes first, looking;
  work_on(study, folder.path(), first, true);
  study.tests = {trial_test("walks", 1.0)};
  study.tests[0].reach_m = 0.1;
  try {
    work_on(study, folder.path(), looking);
    ADD_FAILURE() << "it would fail again and again";
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("the test 'walks' has reach_m and looks through all champions of a run, "
                        "and these were discarded"),
              std::string::npos)
        << error.what();
  }
  EXPECT_TRUE(ledger::Ledger(ledger::StudyPaths(folder.path())).load("sine", 3).tests.empty());
}

TEST(Worker, TakesNoOtherRunForTheOneWhoseFirstWalkerItLooksFor) {
  const test::TemporaryFolder folder;
  auto study = small_study();
  Notes first, looking;
  work_on(study, folder.path(), first, true);
  const Plan plan = make_plan(study, folder.path());
  experiment::Run::start(plan.folder(plan.runs[0]), plan.config(plan.runs[0]), 1);
  study.tests = {trial_test("walks", 1.0), trial_test("plain", 1.0)};
  study.tests[0].reach_m = 0.1;
  EXPECT_EQ(work_on(study, folder.path(), looking).failed, 1);
  EXPECT_NE(looking.failures.at(0).find("is gone or is not that run"), std::string::npos)
      << looking.failures.at(0);
  const auto record = ledger::Ledger(plan.paths).load("sine", 3);
  ASSERT_EQ(record.tests.size(), 1u) << "the test that can be run is";
  EXPECT_EQ(record.tests[0].name, "plain");
}

TEST(Worker, LeavesNoFolderOfRunsThatOthersFinishedSinceItLooked) {
  const test::TemporaryFolder folder;
  const auto study = small_study();
  Notes notes;
  work_on(study, folder.path(), notes, true);
  const Plan plan = make_plan(study, folder.path());
  const std::atomic<bool> never{false};
  const auto result = work(plan, {RunStatus::missing}, {.shard = {}}, notes, never);
  EXPECT_EQ(result.finished + result.failed + result.elsewhere, 0);
  EXPECT_FALSE(std::filesystem::exists(plan.folder(plan.runs[0])));
}

TEST(Worker, RemovesTheFoldersOfRunsThatWereFinishedEarlier) {
  const test::TemporaryFolder folder;
  const auto study = small_study();
  Notes notes;
  work_on(study, folder.path(), notes);
  const Plan plan = make_plan(study, folder.path());
  ASSERT_TRUE(experiment::is_run_folder(plan.folder(plan.runs[0])));
  {
    const io::FolderLock somebody(plan.folder(plan.runs[0]));
    work_on(study, folder.path(), notes, true);
    EXPECT_TRUE(experiment::is_run_folder(plan.folder(plan.runs[0]))) << "it is in use";
  }
  work_on(study, folder.path(), notes, true);
  EXPECT_FALSE(std::filesystem::exists(plan.folder(plan.runs[0])));
}

TEST(Worker, LeavesFinishedRunsAloneAndAddsTheTestsTheyLack) {
  const test::TemporaryFolder folder;
  auto study = small_study();
  study.tests = {trial_test("brief", 1.0)};
  Notes first, again, more;
  EXPECT_EQ(work_on(study, folder.path(), first, true).finished, 1);
  EXPECT_FALSE(std::filesystem::exists(ledger::StudyPaths(folder.path()).run("sine", 3)));
  EXPECT_EQ(work_on(study, folder.path(), again).finished, 0);
  study.tests.push_back(trial_test("longer", 2.0));
  EXPECT_EQ(work_on(study, folder.path(), more).finished, 1);
  EXPECT_EQ(more.started, 0) << "nothing is evolved again";
  const ledger::Record &before = first.records.at(0), &after = more.records.at(0);
  ASSERT_EQ(after.tests.size(), 2u);
  EXPECT_EQ(after.tests[0].episodes, before.tests[0].episodes);
  EXPECT_EQ(after.champion, before.champion);
  EXPECT_EQ(after.provenance.claims, before.provenance.claims);
  EXPECT_EQ(after.provenance.finished_utc, before.provenance.finished_utc) << "of the evolution";
  EXPECT_TRUE(before.provenance.added_by.empty());
  ASSERT_EQ(after.provenance.added_by.size(), 1u);
  EXPECT_EQ(after.provenance.added_by.at("longer"), before.provenance.commit);
  EXPECT_EQ(ledger::Ledger(ledger::StudyPaths(folder.path())).load("sine", 3).digest(), after.digest());
}

TEST(Worker, SharesTheTestsThatFinishedRunsLackWithOthers) {
  const test::TemporaryFolder folder;
  auto study = small_study();
  study.seeds = {1, 2, 3, 4, 5, 6};
  Notes before, ours, theirs;
  work_on(study, folder.path(), before, true);
  study.tests = {trial_test("long", 60.0)};
  const Plan plan = make_plan(study, folder.path());
  const auto states = survey(plan);
  const std::atomic<bool> never{false};
  std::thread other([&] { work(plan, states, {.shard = {}}, theirs, never); });
  work(plan, states, {.shard = {}}, ours, never);
  other.join();
  EXPECT_EQ(ours.records.size() + theirs.records.size(), study.seeds.size()) << "none is tested twice";
  EXPECT_EQ(survey(plan), std::vector<RunStatus>(study.seeds.size(), RunStatus::done));
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    EXPECT_FALSE(entry.path().filename().string().starts_with(".tests")) << entry.path() << " is left";
}

TEST(Worker, MakesATestAgainThatAnotherBuildMadeAndNoOther) {
  const test::TemporaryFolder folder;
  auto study = small_study();
  study.tests = {trial_test("brief", 1.0), trial_test("longer", 2.0)};
  Notes notes;
  work_on(study, folder.path(), notes, true);
  const ledger::Ledger records{ledger::StudyPaths(folder.path())};
  const auto made_here = records.load("sine", 3);
  auto from_elsewhere = made_here;
  from_elsewhere.provenance.commit = "another";
  for (ledger::TestResult& test : from_elsewhere.tests) test.gait = "of another build";
  records.save(from_elsewhere);

  Plan plan = make_plan(study, folder.path());
  plan.retest({"longer"});
  const std::atomic<bool> never{false};
  EXPECT_EQ(survey(plan), std::vector{RunStatus::untested});
  EXPECT_EQ(work(plan, survey(plan), {.shard = {}}, notes, never).finished, 1);
  const auto after = records.load("sine", 3);
  EXPECT_EQ(after.find_test("brief")->gait, "of another build");
  EXPECT_EQ(after.find_test("longer")->gait, made_here.find_test("longer")->gait);
  EXPECT_EQ(after.provenance.commit, "another");
  EXPECT_EQ(after.provenance.added_by.at("longer"), made_here.provenance.commit);
  EXPECT_EQ(survey(plan), std::vector{RunStatus::done}) << "it was made by this build now";
  EXPECT_THROW(plan.retest({"brief", "no such test"}), UserError);
}

TEST(Worker, AddsATestThatTakesThePlaceOfAnotherAndKeepsWhatWasMeasured) {
  const test::TemporaryFolder folder;
  auto study = small_study();
  study.tests = {trial_test("short", 1.0)};
  Notes notes;
  work_on(study, folder.path(), notes, true);
  const ledger::Ledger records{ledger::StudyPaths(folder.path())};
  const auto before = records.load("sine", 3);
  study.tests = {trial_test("long", 2.0)};
  EXPECT_EQ(work_on(study, folder.path(), notes, true).finished, static_cast<int>(study.seeds.size()));
  const auto after = records.load("sine", 3);
  ASSERT_EQ(after.tests.size(), 2U);
  EXPECT_EQ(after.tests[0].name, "long");
  EXPECT_EQ(after.tests[1].name, "short");
  EXPECT_EQ(after.tests[1].path_m, before.tests[0].path_m);
  EXPECT_EQ(work_on(study, folder.path(), notes, true).finished, 0);
}

TEST(Worker, KeepsTheHashOfTheClaimsAtTheEndOfTheRun) {
  const test::TemporaryFolder folder;
  auto study = small_study();
  study.tests = {trial_test("brief", 1.0)};
  Notes first, later;
  work_on(study, folder.path(), first);
  const std::string claims = study.claims_hash();
  study.claims.emplace_back().text = "A claim made afterwards.";
  study.tests.push_back(trial_test("longer", 2.0));
  ASSERT_NE(study.claims_hash(), claims);
  work_on(study, folder.path(), later);
  EXPECT_EQ(first.records.at(0).provenance.claims, claims);
  EXPECT_EQ(later.records.at(0).provenance.claims, claims);
}

/// Works on seven runs, seeds 1 to 7: of '-' the folder cannot be made, of 'x' a file has its name.
WorkResult work_on_seven(const std::string& runs, Notes& notes) {
  const test::TemporaryFolder folder;
  auto study = small_study();
  study.generations = 1;
  study.seeds = {1, 2, 3, 4, 5, 6, 7};
  const ledger::StudyPaths paths(folder.path());
  for (const int seed : {1, 2, 3, 4, 5, 6, 7}) {
    const auto place = paths.run("sine", seed);
    std::filesystem::create_directories(place.parent_path());
    const char kind = runs[static_cast<std::size_t>(seed - 1)];
    if (kind == '-') std::filesystem::create_symlink(folder.path() / "gone" / "away", place);
    if (kind == 'x') io::write_file(place, "no folder");
  }
  return work_on(study, folder.path(), notes);
}

TEST(Worker, GoesOnAfterRunsThatFailUnlessTheDiskRefusesThreeInARow) {
  struct Case {
    std::string runs;
    int finished, failed;
  };
  for (const auto& [runs, finished, failed] : std::vector<Case>{{"-......", 6, 1},
                                                                {"--.--.-", 2, 5},
                                                                {"-.-.-.-", 3, 4},
                                                                {"--x--x.", 1, 6},
                                                                {"xxxx...", 3, 4},
                                                                {"..---..", 2, 3},
                                                                {"--.---.", 1, 5}}) {
    Notes notes;
    const WorkResult result = work_on_seven(runs, notes);
    EXPECT_EQ(result.finished, finished) << runs;
    EXPECT_EQ(result.failed, failed) << runs;
    EXPECT_EQ(notes.failures.size(), static_cast<std::size_t>(failed)) << runs;
    EXPECT_EQ(result.first_failure, runs.find('x') < runs.find('-') ? ExitCode::bad_input : ExitCode::io)
        << runs;
  }
}

}  // namespace
}  // namespace amble::study
