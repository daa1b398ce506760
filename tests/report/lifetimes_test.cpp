#include "amble/report/lifetimes.hpp"

#include <gtest/gtest.h>

#include "amble/report/curves.hpp"
#include "tests/report/fixture.hpp"

namespace amble::report {
namespace {

TEST(Lifetimes, AreCensoredAtTheLengthOfTheTest) {
  const auto tables = survival_tables(small_study());
  ASSERT_EQ(tables.size(), 4u) << "two tests, two activities";
  const SurvivalTable& upright = tables[0];
  EXPECT_EQ(upright.test, "long");
  EXPECT_EQ(upright.activity, Activity::upright);
  EXPECT_EQ(upright.trial_s, 300.0);
  // "a": falls after 40 s, lasts, lasts; "b": falls after 40, 80 and 120 s.
  EXPECT_EQ(upright.conditions.at(0).curve.ended, 1u);
  EXPECT_EQ(upright.conditions.at(1).curve.ended, 3u);
  EXPECT_DOUBLE_EQ(upright.conditions[0].curve.at(300.0), 2.0 / 3.0);
  EXPECT_EQ(upright.conditions[1].curve.at(120.0), 0.0);
  ASSERT_TRUE(upright.log_rank);
  EXPECT_EQ(upright.log_rank->degrees_of_freedom, 1u);
}

TEST(Lifetimes, OfWalkingEndByStandingStillToo) {
  const SurvivalTable walking = survival_tables(small_study())[1];
  EXPECT_EQ(walking.activity, Activity::walking);
  EXPECT_EQ(walking.conditions.at(0).curve.ended, 3u) << "who stays up walks only 200 s";
}

TEST(Lifetimes, OfTestsAsLongAsEvolutionAreNotLong) {
  const auto tables = survival_tables(small_study());
  EXPECT_TRUE(tables[0].is_long);
  EXPECT_FALSE(tables[2].is_long) << "15 s, as the trials of evolution";
  EXPECT_FALSE(tables[2].log_rank) << "nothing ended";
}

TEST(Lifetimes, OfSeveralEpisodesAreThatOfOneOfThem) {
  StudyData data = small_study();
  const auto lifetimes_of = [&data](const std::vector<double>& times_s) {
    ledger::TestResult& test = data.records[0].tests[0];
    test.episodes.clear();
    for (const double time_s : times_s) test.episodes.push_back({1.0, time_s, 0.5 * time_s});
    const auto tables = survival_tables(data);
    return std::pair(tables[0].conditions[0].lifetimes[0], tables[1].conditions[0].lifetimes[0]);
  };
  const auto [two, two_walking] = lifetimes_of({300.0, 100.0});
  EXPECT_EQ(two.time_s, 100.0) << "not 200 s, when nothing ended";
  EXPECT_TRUE(two.ended);
  EXPECT_EQ(two_walking.time_s, 50.0);
  const auto [four, four_walking] = lifetimes_of({300.0, 20.0, 300.0, 300.0});
  EXPECT_EQ(four.time_s, 300.0);
  EXPECT_FALSE(four.ended);
  EXPECT_EQ(lifetimes_of({10.0, 300.0, 90.0}).first.time_s, 90.0);
}

TEST(Lifetimes, OfATestOfTwoLengthsAreShownToTheEndOfTheLonger) {
  StudyData data = small_study();
  for (const std::size_t longer : {0u, 1u, 5u}) {
    for (std::size_t i = 0; i < data.records.size(); ++i)
      data.records[i].tests[0].trial_s = i == longer ? 400.0 : 300.0;
    EXPECT_EQ(survival_tables(data)[0].trial_s, 400.0) << longer;
  }
}

TEST(BestCurves, AreQuartilesOverRuns) {
  StudyData data{.study = sample_study({"a", "b"}, 3), .records = {}, .unknown_files = {}};
  add_runs(data, "a", {2.0, 4.0, 8.0});
  const auto curves = best_curves(data);
  ASSERT_EQ(curves.size(), 1u) << "none of a condition without runs";
  EXPECT_EQ(curves[0].generation.size(), 10u);
  EXPECT_EQ(curves[0].generation.back(), 9);
  EXPECT_EQ(curves[0].median_m[5], 2.0);
  EXPECT_EQ(curves[0].median_m[6], 4.0);
  EXPECT_EQ(curves[0].lower_quartile_m[9], 3.0);
  EXPECT_EQ(curves[0].upper_quartile_m[9], 6.0);
}

TEST(BestCurves, OfLongRunsAreSampledFromFirstToLast) {
  StudyData data{.study = sample_study({"a"}, 2), .records = {}, .unknown_files = {}};
  add_runs(data, "a", {2.0, 4.0});
  data.records[0].generations = 800;
  data.records[1].generations = 1000;
  const auto curve = best_curves(data)[0];
  EXPECT_EQ(curve.generation.size(), 121u);
  EXPECT_EQ(curve.generation.front(), 0);
  EXPECT_EQ(curve.generation.back(), 799) << "as far as the shortest run";
}

}  // namespace
}  // namespace amble::report
