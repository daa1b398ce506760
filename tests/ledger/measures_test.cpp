#include "amble/ledger/measures.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "amble/core/error.hpp"
#include "amble/ledger/study_spec.hpp"
#include "amble/score/score.hpp"
#include "tests/ledger/samples.hpp"

namespace amble::ledger {
namespace {

TEST(Measures, AreTakenFromTheRunOrFromANamedTest) {
  const Record record = sample_record();
  EXPECT_EQ(measure(record, "train_m"), 4.25);
  EXPECT_EQ(measure(record, "hidden"), 3.0);
  EXPECT_EQ(measure(record, "links"), 21.0);
  EXPECT_EQ(measure(record, "five.distance_m"), 12.5);
  EXPECT_EQ(measure(record, "five.upright_s"), 300.0);
  EXPECT_EQ(measure(record, "five.walking_s"), 250.0);
  EXPECT_EQ(measure(record, "noisy.kept"), 3.0 / 4.25);
}

TEST(Measures, OfSeveralEpisodesAreAlsoTheirQuartilesTheLuckiestAndWhatFell) {
  Record record = sample_record();
  record.tests[0].episodes = {{.distance_m = 1.0, .outcome = record::Outcome::fell},
                              {.distance_m = 5.0},
                              {.distance_m = 2.0},
                              {.distance_m = 3.0, .outcome = record::Outcome::fell},
                              {.distance_m = 4.0}};
  EXPECT_EQ(measure(record, "five.distance_m"), 3.0);
  EXPECT_EQ(measure(record, "five.lower_quartile_m"), 2.0);
  EXPECT_EQ(measure(record, "five.upper_quartile_m"), 4.0);
  EXPECT_EQ(measure(record, "five.best_m"), 5.0);
  EXPECT_EQ(measure(record, "five.fell_share"), 0.4);
}

TEST(Measures, SharesAreThoseThatCannotLeaveNoneToAll) {
  for (const char* share :
       {"five.fell_share", "told.tracking", "mutants.viable_share", "coverage", "staying_share"})
    EXPECT_TRUE(is_share(share)) << share;
  for (const char* other : {"five.distance_m", "five.kept", "mutants.mutants_kept", "qd_score", "hidden"})
    EXPECT_FALSE(is_share(other)) << other;
}

TEST(Measures, CostOfTransportIsEnergyByWeightAndWayAndInfiniteOfWhatGoesNowhere) {
  Record record = sample_record();
  EXPECT_FALSE(measure(record, "five.cost_of_transport"));
  record.tests[0].episodes[0].spent = {.energy_j = 60.0, .way_m = 3.0, .weight_n = 10.0};
  EXPECT_EQ(measure(record, "five.cost_of_transport"), 2.0);
  EXPECT_EQ(parse_record(record_text(record), "record").tests[0].episodes[0].spent,
            record.tests[0].episodes[0].spent);
  record.tests[0].episodes.push_back(record.tests[0].episodes[0]);
  record.tests[0].episodes[1].spent = {.energy_j = 40.0, .way_m = 1.0, .weight_n = 10.0};
  EXPECT_EQ(measure(record, "five.cost_of_transport"), 2.5) << "of all the way";
  for (EpisodeResult& episode : record.tests[0].episodes) episode.spent->way_m = 0.0;
  EXPECT_EQ(measure(record, "five.cost_of_transport"), std::numeric_limits<double>::infinity());
}

TEST(Measures, TheScoreOfATestIsTheMedianOfItsEpisodesInTheUnitOfTheConfigs) {
  Record record = sample_record();
  EXPECT_FALSE(measure(record, "five.score"));
  record.tests[0].episodes[0].score = 3.5;
  record.tests[0].episodes.push_back(record.tests[0].episodes[0]);
  record.tests[0].episodes[1].score = 1.0;
  EXPECT_EQ(measure(record, "five.score"), 2.25);
  EXPECT_EQ(measure(parse_record(record_text(record), "record"), "five.score"), 2.25);
}

TEST(Measures, OfSeamsAndSwitchesAreThoseOfTheRecord) {
  Record record = sample_record();
  EXPECT_FALSE(measure(record, "five.jump_rad"));
  EXPECT_FALSE(measure(record, "five.switch_s"));
  record.tests[0].seam = {.jumps = 12, .mean_rad = 0.25, .largest_rad = 0.5, .power_w = 3.5};
  record.tests[0].episodes[0].obeyed = {.tracking = 0.5, .switch_s = 1.5};
  EXPECT_EQ(measure(record, "five.jumps"), 12.0);
  EXPECT_EQ(measure(record, "five.jump_rad"), 0.25);
  EXPECT_EQ(measure(record, "five.jump_power_w"), 3.5);
  EXPECT_EQ(measure(record, "five.switch_s"), 1.5);
  const TestResult read = parse_record(record_text(record), "record").tests[0];
  EXPECT_EQ(read.seam, record.tests[0].seam);
  EXPECT_EQ(read.episodes[0].obeyed, record.tests[0].episodes[0].obeyed);
}

/// A test whose path goes `steps_m` along x from sample to sample.
TestResult path_test(double interval_s, const std::vector<double>& steps_m) {
  TestResult test = sample_record().tests[0];
  test.name = "walk";
  test.path_interval_s = interval_s;
  test.path_m.clear();
  double x_m = 0.0;
  for (const double step_m : steps_m) {
    x_m += step_m;
    test.path_m.insert(test.path_m.end(), {x_m, 0.0});
  }
  return test;
}

TEST(Measures, TimeInMotionLeavesPausesOutAndCountsWhatFollowsThem) {
  EXPECT_EQ(path_test(1.0, std::vector<double>(60, 0.03)).moving_s(), 60.0);
  EXPECT_EQ(path_test(1.0, std::vector<double>(60, 0.02)).moving_s(), 0.0);
  EXPECT_EQ(path_test(1.0, std::vector<double>(9, 1.0)).moving_s(), 0.0) << "no window";
  EXPECT_EQ(path_test(1.0, {}).moving_s(), 0.0);
  // 20 s of walking, 30 s of a pause, 20 s of walking: windows still see the last stride 9 s after it, and
  // the next one when it has gone 25 cm.
  std::vector<double> steps_m(20, 0.1);
  steps_m.insert(steps_m.end(), 30, 0.0);
  steps_m.insert(steps_m.end(), 20, 0.1);
  EXPECT_EQ(path_test(1.0, steps_m).moving_s(), 20.0 + 7.0 + 18.0);
  // Where a path is sampled more rarely than once in a window, each step is a window.
  EXPECT_EQ(path_test(36.0, {1.0, 0.2, 0.3}).moving_s(), 72.0);
  Record record = sample_record();
  record.tests.push_back(path_test(1.0, std::vector<double>(12, 0.03)));
  EXPECT_EQ(measure(record, "walk.moving_s"), 12.0);
}

TEST(Measures, TimeInMotionIsNothingOfTrialsThatAreShorterThanItsWindow) {
  Record record = sample_record();
  record.tests.push_back(path_test(0.5, std::vector<double>(20, 0.1)));
  TestResult& test = record.tests.back();
  test.trial_s = 9.99;
  EXPECT_EQ(measure(record, "walk.moving_s"), std::nullopt);
  EXPECT_EQ(measure(record, "walk.walking_s"), 250.0);
  test.trial_s = 10.0;
  EXPECT_EQ(measure(record, "walk.moving_s"), 10.0);
}

TEST(Measures, OfATestThatWasNotMadeIsNothing) {
  EXPECT_EQ(measure(sample_record(), "ten.distance_m"), std::nullopt);
  EXPECT_EQ(measure(sample_record(), "five.height_m"), std::nullopt);
  EXPECT_EQ(measure(sample_record(), "height_m"), std::nullopt);
}

TEST(Measures, ShareKeptOfNoDistanceIsZero) {
  Record record = sample_record();
  record.best_objective = 0.0;
  EXPECT_EQ(measure(record, "five.kept"), 0.0);
}

TEST(Measures, ShareKeptIsNothingWhereTheObjectiveIsNoDistance) {
  Record record = sample_record();
  EXPECT_EQ(objective_of(record), record::Objective());
  score::Settings score;
  score.terms[0].weight = 2.0;
  record.champion["score"] = io::settings_to_json(score);
  EXPECT_EQ(objective_of(record), (record::Objective{.is_distance = false, .unit = " m", .title = "Score"}));
  EXPECT_EQ(measure(record, "five.kept"), std::nullopt);
  EXPECT_EQ(measure(record, "five.distance_m"), 12.5);
  score.terms.push_back({.quantity = "economy"});
  record.champion["score"] = io::settings_to_json(score);
  EXPECT_EQ(objective_of(record), (record::Objective{.is_distance = false, .unit = "", .title = "Score"}));
}

TEST(Measures, HaveAUnitByTheEndOfTheirNameAndTheObjectivesInEvolution) {
  const record::Objective distance, score{.is_distance = false, .unit = "", .title = "Score"};
  EXPECT_EQ(measure_unit("train_m", distance), " m");
  EXPECT_EQ(measure_unit("train_m", score), "");
  EXPECT_EQ(measure_unit("five.distance_m", score), " m");
  EXPECT_EQ(measure_unit("five.score", score), "");
  EXPECT_EQ(measure_unit("five.score", distance), " m");
  EXPECT_EQ(measure_unit("five.walking_s", score), " s");
  EXPECT_EQ(measure_unit("links", distance), "");
  EXPECT_EQ(measure_unit("five.kept", distance), "");
}

TEST(Measures, OfAnUnreadableScoreNameTheRecord) {
  Record record = sample_record();
  record.champion["score"] = {{"terms", 3}};
  try {
    measure(record, "five.kept");
    ADD_FAILURE();
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("the record of supg, seed 7: key 'champion.score.terms'"),
              std::string::npos)
        << error.what();
  }
}

TEST(Measures, OfMutantsAreTakenFromThoseOfTheTest) {
  Record record = sample_record();
  record.tests[0].mutants = {{0.2, 0.5}, {0.5, 0.125}, {0.7, 0.25}, {0.49, 0.5}, {1.1, 0.75}};
  EXPECT_EQ(measure(record, "five.viable_share"), 0.6);
  EXPECT_EQ(measure(record, "five.mutants_kept"), 0.5);
  EXPECT_EQ(measure(record, "five.gait_change"), 0.375);
  EXPECT_EQ(measure(record, "noisy.viable_share"), std::nullopt);
  record.tests[0].mutants = {{0.2, 0.5}};
  EXPECT_EQ(measure(record, "five.gait_change"), 0.0);
}

TEST(Measures, OfMutantsAreKnownOfTestsThatHaveThem) {
  StudySpec study;
  study.tests.emplace_back().name = "five";
  EXPECT_FALSE(is_measure(study, "five.viable_share"));
  study.tests[0].mutants = 10;
  EXPECT_TRUE(is_measure(study, "five.viable_share"));
  EXPECT_TRUE(is_measure(study, "five.walking_s"));
  EXPECT_FALSE(is_measure(study, "five.reached_s"));
}

TEST(Measures, OfCorrectedMapsAreKnownOfStudiesThatMakeThem) {
  StudySpec study;
  EXPECT_TRUE(is_measure(study, "qd_score"));
  for (const auto* name : {"corrected_coverage", "corrected_qd_score", "staying_share"}) {
    study.map_trials = 0;
    EXPECT_FALSE(is_measure(study, name));
    study.map_trials = 20;
    EXPECT_TRUE(is_measure(study, name));
    EXPECT_NE(measure_label(name), name);
  }
}

TEST(Measures, AreKnownByTheStudysTests) {
  StudySpec study;
  study.tests.emplace_back().name = "five";
  EXPECT_TRUE(is_measure(study, "train_m"));
  EXPECT_TRUE(is_measure(study, "five.walking_s"));
  EXPECT_FALSE(is_measure(study, "ten.walking_s"));
  EXPECT_FALSE(is_measure(study, "five.depth"));
  EXPECT_FALSE(is_measure(study, "walking_s"));
}

}  // namespace
}  // namespace amble::ledger
