#include "amble/report/stop_rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "amble/core/random.hpp"
#include "amble/report/page.hpp"
#include "tests/report/fixture.hpp"

namespace amble::report {
namespace {

using testing::Each;
using testing::HasSubstr;

/// A test whose robot walks at so many metres per second along x until a time, one sample per second.
ledger::TestResult walk(double speed_m_s, int until_s, int trial_s = 300) {
  ledger::TestResult test;
  test.name = "long";
  test.trial_s = trial_s;
  test.path_interval_s = 1.0;
  for (int time_s = 1; time_s <= trial_s; ++time_s) {
    test.path_m.push_back(speed_m_s * std::min(time_s, until_s));
    test.path_m.push_back(0.0);
  }
  ledger::EpisodeResult episode;
  episode.seconds = trial_s;
  episode.walking_s = until_s;
  test.episodes = {episode};
  return test;
}

TEST(WalkingByPath, EndsWhereTheFirstWindowWithinTheRadiusBegins) {
  // At 0.1 m/s, which is a stop for rules slower than it: 1 m in 10 s is the border, and belongs to the stop.
  const auto walked = [](const score::StandingRule& rule) {
    return *walking_by_path_s(walk(0.1, 120), rule);
  };
  EXPECT_EQ(walked({10.0, 0.25}), 118.0) << "two more samples are within 0.25 m of the last place";
  EXPECT_EQ(walked({10.0, 0.05}), 120.0);
  EXPECT_EQ(walked({10.0, 1.0}), 0.0);
  EXPECT_EQ(walked({10.0, 0.99}), 111.0);
  EXPECT_EQ(walked({60.0, 0.25}), 118.0);
}

TEST(WalkingByPath, IsTheWholeEpisodeWithoutAStop) {
  ledger::TestResult test = walk(0.1, 300);
  EXPECT_EQ(walking_by_path_s(test, {10.0, 0.25}), 300.0);
  test.path_m.resize(2 * 40);  // it fell
  test.episodes[0].seconds = 40.3;
  EXPECT_EQ(walking_by_path_s(test, {10.0, 0.25}), 40.3);
  EXPECT_EQ(walking_by_path_s(walk(0.1, 295), {10.0, 0.25}), 300.0) << "a window that the end cuts short";
}

TEST(WalkingByPath, NeedsSamplesThatAreCloseEnough) {
  ledger::TestResult test = walk(0.1, 300);
  test.path_interval_s = 2.1;
  EXPECT_FALSE(walking_by_path_s(test, {10.0, 0.25}));
  test.path_interval_s = 2.0;
  EXPECT_TRUE(walking_by_path_s(test, {10.0, 0.25}));
}

TEST(WalkingByPath, IsKnownOfARobotThatFellBeforeTheFirstSample) {
  ledger::TestResult test = walk(0.1, 300);
  test.path_m.clear();
  test.episodes[0].seconds = 0.4;
  EXPECT_EQ(walking_by_path_s(test, {10.0, 0.25}), 0.4);
}

TEST(WalkingByPath, IsTheMetersWhereThePathHasEveryOneOfItsSamples) {
  Stream stream(2, Purpose::test);
  int stops = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const auto& rule = stop_rules.at(static_cast<std::size_t>(trial) % stop_rules.size());
    score::WalkingMeter meter({}, 0.1, rule);
    ledger::TestResult test = walk(0.0, 0, 100);
    test.path_interval_s = 0.1;
    test.path_m.clear();
    Vec3 com_m{};
    for (int step = 1; step <= 1000; ++step) {
      const double reach_m = step < 15 * trial ? 0.2 : 0.002;
      com_m.x += reach_m * (stream.uniform() - 0.4);
      com_m.y += reach_m * (stream.uniform() - 0.5);
      meter.add(com_m);
      test.path_m.insert(test.path_m.end(), {com_m.x, com_m.y});
    }
    EXPECT_NEAR(*walking_by_path_s(test, rule), meter.walking_s(), 1e-9) << trial;
    stops += meter.walking_s() < 99.0;
  }
  EXPECT_GT(stops, 20);
  EXPECT_LT(stops, 60);
}

/// Six runs of "a" that walk at several speeds, of which the slowest are stops by some rules, and a claim.
StudyData walking_study() {
  StudyData data{.study = sample_study({"a", "b"}, 6), .records = {}, .unknown_files = {}};
  data.study.tests.resize(1);
  data.study.tests[0].name = "long";
  add_runs(data, "a", {1.0, 1.0, 1.0, 1.0, 1.0, 1.0});
  for (ledger::Record& run : data.records)
    run.tests.push_back(walk(0.02 * static_cast<double>(run.seed), run.seed == 6 ? 200 : 300));
  ledger::ClaimSpec claim;
  claim.kind = ledger::ClaimKind::count;
  claim.text = "none walks for 180 s";
  claim.condition = "a";
  claim.measure = "long.walking_s";
  claim.threshold = 180.0;
  claim.at_most = 0.0;
  data.study.claims = {claim};
  return data;
}

TEST(StopCounts, AreOfTheWholeTestAndOfClaimsThatCountWalkers) {
  const auto counts = stop_counts(walking_study());
  ASSERT_EQ(counts.size(), 2u) << "b has no runs";
  EXPECT_FALSE(counts[0].claim);
  EXPECT_EQ(counts[0].at_least_s, 300.0);
  // 0.02, 0.04 … 0.1 m/s to the end; rules slower than 0.05, 0.01, 0.025, 0.05, 0.1, 0.0125, 0.008, 0.004 and
  // 0.017 m/s.
  EXPECT_THAT(counts[0].runs, testing::ElementsAre(3, 5, 4, 3, 0, 5, 5, 5, 5));
  EXPECT_EQ(counts[0].fewest(), 0u);
  EXPECT_EQ(counts[0].most(), 5u);
  EXPECT_EQ(counts[0].metered, 5u) << "as the records say";
  EXPECT_EQ(counts[1].claim, 0u);
  EXPECT_THAT(counts[1].runs, testing::ElementsAre(4, 6, 5, 4, 1, 6, 6, 6, 6)) << "and one until 200 s";
  EXPECT_THAT(counts[1].verdicts, Each(Verdict::contradicted));
}

TEST(StopCounts, AreNoneByRulesWhoseWindowIsLongerThanTheTest) {
  StudyData data = walking_study();
  data.study.claims.clear();
  for (ledger::Record& run : data.records) {
    run.champion["trial"]["duration_s"] = 15.0;
    run.tests[0].trial_s = 25.0;
  }
  const auto counts = stop_counts(data);
  ASSERT_EQ(counts.size(), 1u);
  for (std::size_t rule = 0; rule < stop_rules.size(); ++rule)
    EXPECT_EQ(counts[0].runs[rule].has_value(), stop_rules[rule].window_s <= 25.0) << rule;
}

TEST(StopCounts, AreOfTestsLongerThanTheTrialsOfEvolution) {
  StudyData data = walking_study();
  for (ledger::Record& run : data.records) run.champion["trial"]["duration_s"] = 300.0;
  EXPECT_TRUE(stop_counts(data).empty());
  EXPECT_EQ(make_page(make_report(data)).find("What counts as a stop"), std::string::npos);
  EXPECT_THAT(make_page(make_report(walking_study())), HasSubstr("What counts as a stop"));
}

}  // namespace
}  // namespace amble::report
