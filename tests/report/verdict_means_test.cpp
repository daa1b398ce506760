#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "amble/report/verdict.hpp"
#include "tests/report/fixture.hpp"

namespace amble::report {
namespace {

using ledger::ClaimKind;
using ledger::ClaimSpec;
using ledger::Relation;
using ledger::TwoSampleTest;
using testing::HasSubstr;

class Claims : public testing::Test {
 protected:
  Claims() { data_.study = sample_study({"a", "b"}, 5); }

  ClaimSpec& claim(ClaimKind kind) {
    ClaimSpec claim;
    claim.kind = kind;
    claim.text = "so it is";
    claim.condition = "a";
    if (kind == ClaimKind::difference) claim.against = "b";
    data_.study.claims.push_back(claim);
    return data_.study.claims.back();
  }
  Judgement only() const { return judge(data_).at(0); }

  StudyData data_{};
};

TEST_F(Claims, OfADifferenceIsConfirmedOrContradictedByTheTest) {
  add_runs(data_, "a", {4.0, 4.1, 4.2, 4.3, 4.4});
  add_runs(data_, "b", {1.0, 1.1, 1.2, 1.3, 1.4});
  for (const auto test : {TwoSampleTest::student, TwoSampleTest::welch, TwoSampleTest::mann_whitney}) {
    data_.study.claims.clear();
    claim(ClaimKind::difference).test = test;
    EXPECT_EQ(only().verdict, Verdict::confirmed);
    std::swap(data_.study.claims[0].condition, data_.study.claims[0].against);
    EXPECT_EQ(only().verdict, Verdict::contradicted);
    data_.study.claims[0].relation = Relation::not_less;
    EXPECT_EQ(only().verdict, Verdict::contradicted);
    std::swap(data_.study.claims[0].condition, data_.study.claims[0].against);
    EXPECT_EQ(only().verdict, Verdict::confirmed);
  }
}

TEST_F(Claims, OfADifferenceTellsStudentsNumbers) {
  // Means 4.2 and 1.2, both of variance 0.025: t = 3 / (0.1 √(2 · 0.5)) = 30 with 8 degrees of freedom.
  add_runs(data_, "a", {4.0, 4.1, 4.2, 4.3, 4.4});
  add_runs(data_, "b", {1.0, 1.1, 1.2, 1.3, 1.4});
  claim(ClaimKind::difference);
  const Judgement judged = only();
  EXPECT_NEAR(*judged.estimate, 3.0, 1e-12);
  EXPECT_NEAR(judged.interval->lower, 3.0 - 2.306004 * 0.1, 1e-6);
  EXPECT_LT(*judged.p, 1e-8);
  EXPECT_EQ(judged.p, judged.p_holm) << "a family of one";
  EXPECT_EQ(judged.n, 5u);
  EXPECT_EQ(judged.n_against, 5u);
  EXPECT_EQ(judged.ours, "4.20 m against 1.20 m; difference 3.00 m [2.77, 3.23]");
}

TEST_F(Claims, OfADifferenceHaveIntervalsAt95PercentWhateverTheirLevel) {
  add_runs(data_, "a", {4.0, 4.1, 4.2, 4.3, 4.4});
  add_runs(data_, "b", {1.0, 1.1, 1.2, 1.3, 1.4});
  claim(ClaimKind::difference);
  const auto usual = only().interval;
  data_.study.claims[0].alpha = 0.001;
  EXPECT_EQ(only().interval->lower, usual->lower);
  EXPECT_EQ(only().interval->upper, usual->upper);
}

TEST_F(Claims, OfAValueHaveIntervalsAtTheirOwnLevel) {
  add_runs(data_, "a", {4.0, 5.0, 6.0, 5.0});  // standard error 0.408
  auto& value = claim(ClaimKind::value);
  value.mean = 5.0;
  value.sd = 1.0;
  value.runs = 20;
  EXPECT_NEAR(only().interval->upper, 5.0 + 3.182446 * 0.4082483, 1e-5);
  data_.study.claims[0].alpha = 0.01;
  EXPECT_NEAR(only().interval->upper, 5.0 + 5.840909 * 0.4082483, 1e-5);
}

TEST_F(Claims, TellWhatTheirEstimateIs) {
  add_runs(data_, "a", {4.0, 4.1, 4.2, 4.3, 4.4});
  add_runs(data_, "b", {1.0, 1.1, 1.2, 1.3, 1.4});
  claim(ClaimKind::difference);
  for (const auto& [test, quantity] : {std::pair{TwoSampleTest::student, "difference of means"},
                                       {TwoSampleTest::welch, "difference of means"},
                                       {TwoSampleTest::mann_whitney, "A12"}}) {
    data_.study.claims[0].test = test;
    EXPECT_EQ(only().quantity, quantity);
  }
  std::set<std::string> quantities;
  for (const Judgement& judged : judge(small_study())) {
    EXPECT_NE(judged.quantity, "");
    quantities.insert(judged.quantity);
  }
  EXPECT_EQ(quantities.size(), 6u) << "one of each kind of claim";
}

TEST_F(Claims, OfADifferenceThatIsNotSignificantAreNotConfirmed) {
  add_runs(data_, "a", {1.0, 2.0, 3.0, 4.0, 5.0});
  add_runs(data_, "b", {0.9, 1.9, 2.9, 3.9, 4.9});
  claim(ClaimKind::difference);
  claim(ClaimKind::difference).relation = Relation::not_less;
  const auto judged = judge(data_);
  EXPECT_EQ(judged[0].verdict, Verdict::not_confirmed);
  EXPECT_EQ(judged[1].verdict, Verdict::compatible);
  EXPECT_THAT(judged[1].reason, HasSubstr("not evidence for it"));
  std::swap(data_.study.claims[1].condition, data_.study.claims[1].against);
  EXPECT_EQ(judge(data_)[1].verdict, Verdict::not_confirmed);
}

TEST_F(Claims, OfDifferencesAreOneFamily) {
  data_.study = sample_study({"a", "b", "c"}, 5);
  add_runs(data_, "a", {1.0, 2.0, 3.0, 4.0, 5.0});
  add_runs(data_, "b", {3.0, 4.0, 5.0, 6.0, 7.0});  // t = 2, 8 degrees of freedom: p = 0.080516
  add_runs(data_, "c", {4.5, 5.5, 6.5, 7.5, 8.5});  // t = 3.5 from a, 1.5 from b
  claim(ClaimKind::difference).condition = "b";
  data_.study.claims[0].against = "a";
  claim(ClaimKind::difference).condition = "c";
  data_.study.claims[1].against = "a";
  claim(ClaimKind::count).threshold = 0.0;
  data_.study.claims[2].at_least = 0.0;
  const auto judged = judge(data_);
  EXPECT_NEAR(*judged[0].p, 0.080516, 1e-6);
  EXPECT_NEAR(*judged[1].p, 0.008079, 1e-6);
  EXPECT_DOUBLE_EQ(*judged[1].p_holm, 2.0 * *judged[1].p) << "the smaller one times two";
  EXPECT_DOUBLE_EQ(*judged[0].p_holm, *judged[0].p);
  EXPECT_FALSE(judged[2].p_holm) << "a count is no member";
}

TEST_F(Claims, OfADifferenceNeedTwoRunsOnEachSide) {
  add_runs(data_, "a", {1.0, 2.0, 3.0});
  claim(ClaimKind::difference);
  EXPECT_EQ(only().verdict, Verdict::not_testable);
  EXPECT_THAT(only().reason, HasSubstr("No finished run of b"));
  add_runs(data_, "b", {1.0});
  EXPECT_EQ(only().verdict, Verdict::not_testable);
  EXPECT_EQ(only().reason, "Too few runs: b has 1, 2 are needed.");
  data_.records.pop_back();
  add_runs(data_, "b", {1.0, 2.0});
  EXPECT_NE(only().verdict, Verdict::not_testable);
}

TEST_F(Claims, OfADifferenceWithoutSpreadAreNotTestable) {
  add_runs(data_, "a", {2.0, 2.0});
  add_runs(data_, "b", {1.0, 1.0});
  claim(ClaimKind::difference);
  EXPECT_EQ(only().verdict, Verdict::not_testable);
  EXPECT_FALSE(only().p);
  EXPECT_THAT(only().reason, HasSubstr("same value"));
}

TEST_F(Claims, OfARatioWithinRunsFollowItsInterval) {
  add_runs(data_, "a", {4.0, 5.0, 6.0, 7.0, 5.0, 5.0});
  data_.study.tests.resize(1);
  data_.study.tests[0].name = "long";
  for (ledger::Record& run : data_.records)
    add_test(run, "long", (2.9 + 0.1 * static_cast<double>(run.seed % 3)) * run.best_objective);
  auto& ratio = claim(ClaimKind::ratio);
  ratio.measure = "long.distance_m";
  ratio.base_measure = "train_m";
  ratio.at_least = 2.5;
  EXPECT_EQ(only().verdict, Verdict::confirmed);
  EXPECT_NEAR(*only().estimate, (3.0 * 4 + 3.1 * 5 + 2.9 * 6 + 3.0 * 7 + 3.1 * 5 + 2.9 * 5) / 32.0, 1e-12)
      << "sum over sum";
  data_.study.claims[0].at_least = 3.5;
  EXPECT_EQ(only().verdict, Verdict::contradicted);
  data_.study.claims[0].at_least = 3.0;
  EXPECT_EQ(only().verdict, Verdict::not_confirmed);
  EXPECT_THAT(only().reason, HasSubstr("the estimate itself lies outside it"));
  data_.study.claims[0].at_least = *only().estimate;
  EXPECT_THAT(only().reason, HasSubstr("the estimate itself lies inside it"));
}

TEST_F(Claims, OfARatioOverZeroAreNotTestable) {
  add_runs(data_, "a", {4.0, 5.0, 6.0, 4.0, 5.0, 6.0});
  add_runs(data_, "b", {0.0, 0.0, 0.0, 0.0, 0.0, 3.0});
  auto& ratio = claim(ClaimKind::ratio);
  ratio.against = "b";
  ratio.at_least = 2.0;
  EXPECT_EQ(only().verdict, Verdict::not_testable);
  EXPECT_THAT(only().reason, HasSubstr("denominator"));
}

TEST_F(Claims, ThatNeedABootstrapNeedSixRuns) {
  add_runs(data_, "a", {4.0, 5.0, 6.0, 4.0, 5.0});
  add_runs(data_, "b", {1.0, 1.1, 1.2, 1.3, 1.4, 1.5});
  auto& ratio = claim(ClaimKind::ratio);
  ratio.against = "b";
  ratio.at_least = 2.0;
  claim(ClaimKind::plateau).from_generation = 5;
  data_.study.claims[1].at_most = 0.9;
  for (const Judgement& judged : judge(data_)) {
    EXPECT_EQ(judged.verdict, Verdict::not_testable);
    EXPECT_EQ(judged.reason, "Too few runs: a has 5, 6 are needed.");
  }
  data_.records.insert(data_.records.begin() + 5, sample_run("a", 6, 5.0));
  for (const Judgement& judged : judge(data_)) EXPECT_EQ(judged.verdict, Verdict::confirmed);
}

TEST_F(Claims, OfRanksNeedSamplesThatCanReachTheLevel) {
  add_runs(data_, "a", {4.0, 5.0, 6.0});
  add_runs(data_, "b", {1.0, 2.0, 3.0});
  claim(ClaimKind::difference).test = TwoSampleTest::mann_whitney;
  EXPECT_EQ(only().verdict, Verdict::not_testable) << "3 against 3 stay at p = 0.1";
  EXPECT_EQ(only().reason, "Too few runs: with 3 and 3 no outcome of this test has a p below 0.10.");
  data_.study.claims[0].alpha = 0.2;
  EXPECT_EQ(only().verdict, Verdict::not_confirmed) << "significant, but of fewer than five";
  EXPECT_THAT(only().reason, HasSubstr("Too few runs: a has 3, 5 are needed."));
}

TEST_F(Claims, OfAValueAgreeDisagreeOrNeither) {
  add_runs(data_, "a", {4.0, 5.0, 6.0, 4.0, 6.0});  // mean 5, sd 1, 95 % interval [3.76, 6.24]
  auto& value = claim(ClaimKind::value);
  value.sd = 1.0;
  value.runs = 20;
  value.mean = 5.2;
  EXPECT_EQ(only().verdict, Verdict::compatible);
  EXPECT_THAT(only().reason, HasSubstr("not evidence for it"));
  EXPECT_THAT(only().reason, HasSubstr("less than 25 % of the published one is not shown"));
  data_.study.claims[0].mean = 9.0;
  EXPECT_EQ(only().verdict, Verdict::contradicted);
  data_.study.claims[0].mean = 6.5;
  data_.study.claims[0].sd = 6.0;  // so wide that no test finds a difference
  EXPECT_EQ(only().verdict, Verdict::not_confirmed);
  EXPECT_THAT(only().reason, HasSubstr("outside our interval"));
}

TEST_F(Claims, OfAValueAreConfirmedByEquivalenceAndTheSpreadOnly) {
  data_.study = sample_study({"a"}, 20);
  std::vector<double> best_m;
  for (int i = 0; i < 20; ++i) best_m.push_back(5.0 + 0.1 * (i % 5 - 2));  // mean 5, sd 0.145
  add_runs(data_, "a", best_m);
  auto& value = claim(ClaimKind::value);
  value.mean = 5.05;
  value.sd = 0.15;
  value.runs = 20;
  EXPECT_EQ(only().verdict, Verdict::confirmed);
  EXPECT_LT(*only().p_equivalence, 1e-10);
  data_.study.claims[0].within = 0.02;
  EXPECT_EQ(only().verdict, Verdict::compatible) << "0.1 m is too narrow a margin for the difference";
  data_.study.claims[0].within = 0.25;
  data_.study.claims[0].sd = 0.4;
  EXPECT_EQ(only().verdict, Verdict::not_confirmed) << "so wide a spread was not found";
  EXPECT_LT(*only().p_spread, 0.001);
  EXPECT_THAT(only().reason, HasSubstr("The spreads differ significantly"));
}

TEST_F(Claims, OfNoLossAreConfirmedByAMarginThatWasStated) {
  data_.study = sample_study({"a", "b"}, 20);
  std::vector<double> best_m;
  for (int i = 0; i < 20; ++i) best_m.push_back(5.0 + 0.1 * (i % 5 - 2));
  add_runs(data_, "a", best_m);
  add_runs(data_, "b", best_m);
  claim(ClaimKind::difference).relation = Relation::not_less;
  EXPECT_EQ(only().verdict, Verdict::compatible);
  EXPECT_FALSE(only().p_equivalence);
  data_.study.claims[0].margin = 0.2;
  EXPECT_EQ(only().verdict, Verdict::confirmed);
  EXPECT_THAT(only().reason, HasSubstr("not worse by more than the stated 0.2 is shown"));
  data_.study.claims[0].margin = 0.05;
  EXPECT_EQ(only().verdict, Verdict::compatible);
  EXPECT_THAT(only().reason, HasSubstr("is not shown"));
}

TEST_F(Claims, ThatNothingIsLostTakeNoPowerFromThoseOfALead) {
  data_.study = sample_study({"a", "b", "c"}, 5);
  add_runs(data_, "a", {1.0, 2.0, 3.0, 4.0, 5.0});
  add_runs(data_, "b", {3.0, 4.0, 5.0, 6.0, 7.0});
  add_runs(data_, "c", {4.5, 5.5, 6.5, 7.5, 8.5});
  const std::vector<std::pair<const char*, const char*>> pairs{{"b", "a"}, {"c", "a"}, {"c", "b"}};
  for (const auto relation : {Relation::greater, Relation::not_less})
    for (const auto& [first, second] : pairs) {
      ClaimSpec& one = claim(ClaimKind::difference);
      one.condition = first;
      one.against = second;
      one.relation = relation;
    }
  const auto judged = judge(data_);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(judged[i].p, judged[i + 3].p);
    EXPECT_EQ(judged[i].p_holm, judged[i + 3].p_holm) << "two families of three";
  }
  EXPECT_DOUBLE_EQ(*judged[1].p_holm, 3.0 * *judged[1].p);
}

/// Runs of "a" and "b" with a test that is to reach a distance; those whose generation is negative never do.
void add_reaching_runs(StudyData& data, const std::vector<int>& a, const std::vector<int>& b) {
  data.study.tests.resize(1);
  data.study.tests[0].name = "far";
  data.study.tests[0].reach_m = 100.0;
  add_runs(data, "a", std::vector<double>(a.size(), 2.0));
  add_runs(data, "b", std::vector<double>(b.size(), 1.0));
  for (std::size_t i = 0; i < data.records.size(); ++i) {
    add_test(data.records[i], "far", 50.0);
    ledger::TestResult& test = data.records[i].tests.back();
    test.reach_m = 100.0;
    const int generation = i < a.size() ? a[i] : b[i - a.size()];
    if (generation >= 0) test.reached = {.generation = generation};
  }
}

TEST_F(Claims, OfMeansSayHowManyRunsNeverReachedWhatIsMeasured) {
  add_reaching_runs(data_, {3, -1, 4, 5, -1, 6}, {7, 8, 9, 8, 7, -1});
  const std::string of_a = "2 of 6 runs of a never reached it: there is no mean.",
                    of_b = "1 of 6 runs of b never reached it: there is no mean.";
  for (const ClaimKind kind : {ClaimKind::difference, ClaimKind::ratio, ClaimKind::value, ClaimKind::count})
    claim(kind).measure = "far.reached_generation";
  auto& claims = data_.study.claims;
  claims.push_back(claims[0]);
  claims[4].test = TwoSampleTest::welch;
  claims[1].against = "b";
  claims.push_back(claims[1]);
  claims[5].against.clear();
  claims[5].base_measure = "train_m";
  claims[2].sd = 1.0;
  claims[2].runs = 20;
  claims[3].threshold_condition = "b";
  claims[3].at_least = 1;
  const auto judged = judge(data_);
  for (const Judgement& one : judged) EXPECT_EQ(one.verdict, Verdict::not_testable);
  EXPECT_EQ(judged[0].reason, of_a + " " + of_b);
  EXPECT_EQ(judged[1].reason, of_a + " " + of_b);
  EXPECT_EQ(judged[2].reason, of_a);
  EXPECT_EQ(judged[3].reason, of_b);
  EXPECT_EQ(judged[4].reason, of_a + " " + of_b);
  EXPECT_EQ(judged[5].reason, of_a);
  for (const Judgement& one : judged) EXPECT_FALSE(one.p || one.estimate || one.mean);
}

TEST_F(Claims, OfRanksTakeRunsThatNeverReachItAsTheLargest) {
  add_reaching_runs(data_, {-1, 30, -1, 40, -1}, {1, 2, 3, 4, 5});
  claim(ClaimKind::difference).measure = "far.reached_generation";
  data_.study.claims[0].test = TwoSampleTest::mann_whitney;
  EXPECT_EQ(only().verdict, Verdict::confirmed);
  EXPECT_EQ(only().estimate, 1.0);
  EXPECT_THAT(only().ours, testing::StartsWith("2 of 5 runs reached it against 5 of 5; A12 1"));
}

TEST_F(Claims, OfAPlateauFollowTheIntervalOfTheGain) {
  add_runs(data_, "a", {4.0, 5.0, 6.0, 4.0, 5.0, 6.0});  // each has half its distance until generation 6
  auto& plateau = claim(ClaimKind::plateau);
  plateau.from_generation = 6;
  plateau.at_most = 0.05;
  EXPECT_EQ(only().verdict, Verdict::confirmed);
  EXPECT_EQ(only().estimate, 0.0);
  data_.study.claims[0].from_generation = 5;
  EXPECT_EQ(only().verdict, Verdict::contradicted);
  EXPECT_EQ(only().estimate, 0.5);
  for (int i : {0, 1}) data_.records[static_cast<std::size_t>(i)].curve = {{0, 4.0}};
  data_.study.claims[0].at_most = 0.4;
  EXPECT_EQ(only().verdict, Verdict::not_confirmed);
  data_.study.claims[0].from_generation = 9;
  EXPECT_EQ(only().verdict, Verdict::not_testable) << "generation 9 is the last";
  EXPECT_THAT(only().reason, HasSubstr("not longer than 9 generations"));
}

}  // namespace
}  // namespace amble::report
