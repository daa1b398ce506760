#include "amble/report/comparisons.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "amble/statistics/hypothesis_tests.hpp"
#include "tests/report/fixture.hpp"

namespace amble::report {
namespace {

TEST(Summaries, HaveBootstrapIntervalsOfDistancesOnly) {
  const auto summaries = summarize(large_study(2, 6));
  EXPECT_EQ(summaries.size(), 2u * (3u + 2u * 5u)) << "every measure in both conditions";
  const auto* distance = find_summary(summaries, "long.distance_m", "c0");
  ASSERT_NE(distance, nullptr);
  EXPECT_TRUE(distance->median && distance->interquartile_mean);
  EXPECT_FALSE(find_summary(summaries, "hidden", "c0")->median);
  EXPECT_EQ(find_summary(summaries, "hidden", "c2"), nullptr);
  EXPECT_FALSE(find_summary(summarize(large_study(2, 5)), "long.distance_m", "c0")->median) << "too few runs";
}

TEST(Summaries, OfOneRunHaveNoIntervals) {
  StudyData data{.study = sample_study({"a", "b"}, 3), .records = {}, .unknown_files = {}};
  add_runs(data, "a", {4.0});
  const auto summaries = summarize(data);
  const auto* distance = find_summary(summaries, "train_m", "a");
  ASSERT_NE(distance, nullptr);
  EXPECT_EQ(distance->planned, 3u);
  EXPECT_FALSE(distance->summary.sd || distance->summary.mean_interval || distance->median);
  EXPECT_EQ(find_summary(summaries, "train_m", "b"), nullptr);
}

TEST(Summaries, IntervalsOfSharesStayBetweenNoneAndAll) {
  StudyData data = small_study();
  data.study.tests[0].episodes = 4;
  const auto fell_share = [&](const std::vector<std::size_t>& falls) {
    for (std::size_t run = 0; run < falls.size(); ++run) {
      auto& episodes = data.records[run].tests[0].episodes;
      episodes.assign(4, {.distance_m = 1.0});
      for (std::size_t e = 0; e < falls[run]; ++e) episodes[e].outcome = record::Outcome::fell;
    }
    return find_summary(summarize(data), "long.fell_share", "a")->summary;
  };
  const statistics::Summary few = fell_share({0, 0, 1}), many = fell_share({4, 4, 3});
  EXPECT_NEAR(few.mean, 1.0 / 12.0, 1e-12);
  EXPECT_EQ(few.mean_interval->lower, 0.0);
  EXPECT_NEAR(few.mean_interval->upper, 1.0 / 12.0 + 4.302653 * 0.144338 / std::sqrt(3.0), 1e-5);
  EXPECT_EQ(many.mean_interval->upper, 1.0);
  EXPECT_NEAR(many.mean_interval->lower, 11.0 / 12.0 - 4.302653 * 0.144338 / std::sqrt(3.0), 1e-5);
}

TEST(Pairs, AreAllPairsOfOneMeasureAndEachTestIsAFamily) {
  const auto tables = compare_pairs(large_study(5, 4));
  ASSERT_EQ(tables.size(), 3u) << "evolution and two tests";
  for (const PairTable& table : tables) {
    ASSERT_EQ(table.pairs.size(), 10u);
    std::vector<double> student, ranks;
    for (const Pair& pair : table.pairs) {
      student.push_back(pair.student->test.p);
      ranks.push_back(pair.mann_whitney->test.p);
    }
    const auto student_holm = statistics::holm(student), ranks_holm = statistics::holm(ranks);
    for (std::size_t i = 0; i < 10; ++i) {
      EXPECT_EQ(table.pairs[i].student->p_holm, student_holm[i]);
      EXPECT_EQ(table.pairs[i].mann_whitney->p_holm, ranks_holm[i]);
    }
  }
}

TEST(Pairs, LeaveOutConditionsWithTooFewRuns) {
  StudyData data{.study = sample_study({"a", "b", "c"}, 3), .records = {}, .unknown_files = {}};
  add_runs(data, "a", {4.0, 5.0});
  add_runs(data, "b", {4.0});
  EXPECT_TRUE(compare_pairs(data).empty());
  add_runs(data, "c", {1.0, 2.0, 3.0});
  const auto tables = compare_pairs(data);
  ASSERT_EQ(tables.size(), 1u);
  ASSERT_EQ(tables[0].pairs.size(), 1u);
  EXPECT_EQ(tables[0].pairs[0].first + tables[0].pairs[0].second, "ac");
  EXPECT_EQ(tables[0].pairs[0].superiority->a12, 1.0);
}

TEST(Pairs, AreOfConditionsWithTwoRunsOrMore) {
  for (const int runs_of_a : {0, 1, 2, 3})
    for (const int runs_of_b : {0, 1, 2, 3}) {
      StudyData data{.study = sample_study({"a", "b"}, 3), .records = {}, .unknown_files = {}};
      const std::vector<double> best_m{1.0, 3.0, 2.0};
      add_runs(data, "a", {best_m.begin(), best_m.begin() + runs_of_a});
      add_runs(data, "b", {best_m.begin(), best_m.begin() + runs_of_b});
      const auto tables = compare_pairs(data);
      ASSERT_EQ(tables.size(), runs_of_a >= 2 && runs_of_b >= 2 ? 1u : 0u) << runs_of_a << ", " << runs_of_b;
      if (tables.empty()) continue;
      ASSERT_EQ(tables[0].pairs.size(), 1u);
      EXPECT_EQ(tables[0].pairs[0].n_first, static_cast<std::size_t>(runs_of_a));
      EXPECT_EQ(tables[0].pairs[0].n_second, static_cast<std::size_t>(runs_of_b));
      EXPECT_TRUE(tables[0].pairs[0].student && tables[0].pairs[0].welch && tables[0].pairs[0].mann_whitney);
    }
}

}  // namespace
}  // namespace amble::report
