#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amble/report/gait_counts.hpp"
#include "amble/report/verdict.hpp"
#include "tests/report/fixture.hpp"

namespace amble::report {
namespace {

using ledger::ClaimKind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

/// A study of one condition of `planned` runs, of which some are finished, and one claim.
struct OneClaim {
  explicit OneClaim(ClaimKind kind, int planned, const std::vector<double>& best_m) {
    data.study = sample_study({"a", "b"}, planned);
    add_runs(data, "a", best_m);
    ledger::ClaimSpec claim;
    claim.kind = kind;
    claim.text = "so it is";
    claim.condition = "a";
    data.study.claims = {claim};
  }
  ledger::ClaimSpec& claim() { return data.study.claims[0]; }
  Judgement judged() const { return judge(data).at(0); }

  StudyData data{};
};

TEST(CountClaims, CountFromTheThresholdOn) {
  OneClaim one(ClaimKind::count, 5, {3.0, 4.0, 5.0, 3.9, 1.0});
  one.claim().threshold = 4.0;
  one.claim().at_least = 2;
  EXPECT_EQ(one.judged().verdict, Verdict::confirmed) << "4.0 itself counts";
  EXPECT_EQ(one.judged().ours, "2 of 5, 40 % [5, 85]");
  one.claim().at_least = 3;
  EXPECT_EQ(one.judged().verdict, Verdict::contradicted);
}

TEST(CountClaims, WaitForRunsThatCouldDecide) {
  OneClaim one(ClaimKind::count, 7, {3.0, 4.0, 5.0, 3.9, 1.0});
  one.claim().threshold = 4.0;
  one.claim().at_least = 3;
  EXPECT_EQ(one.judged().verdict, Verdict::not_testable);
  EXPECT_THAT(one.judged().reason, HasSubstr("2 missing decide"));
  one.claim().at_least = 5;
  EXPECT_EQ(one.judged().verdict, Verdict::contradicted);
}

TEST(CountClaims, TakeAnothersMeanAsThreshold) {
  OneClaim one(ClaimKind::count, 5, {3.0, 4.0, 5.0, 3.9, 1.0});
  one.claim().threshold_condition = "b";
  one.claim().at_most = 1;
  EXPECT_EQ(one.judged().verdict, Verdict::not_testable);
  EXPECT_THAT(one.judged().reason, HasSubstr("No finished run of b"));
  add_runs(one.data, "b", {4.0, 5.0, 6.0, 5.0, 5.0});
  EXPECT_EQ(one.judged().verdict, Verdict::confirmed);
  EXPECT_THAT(one.judged().ours, HasSubstr("threshold 5.00 m"));
}

TEST(CountClaims, OfAnothersMeanWaitForItsRunsAndNeedFiveOfThem) {
  OneClaim one(ClaimKind::count, 6, {3.0, 4.0, 5.0, 3.9, 1.0, 2.0});
  one.claim().threshold_condition = "b";
  one.claim().at_most = 2;
  add_runs(one.data, "b", {4.0, 6.0});
  EXPECT_EQ(one.judged().verdict, Verdict::not_testable) << "four runs more move the threshold";
  EXPECT_THAT(one.judged().reason, HasSubstr("4 runs of it missing move it"));
  EXPECT_EQ(one.judged().n_against, 2u);
  EXPECT_EQ(one.judged().planned_against, 6u);
  one.data.study.conditions[1].seeds = {1, 2};
  EXPECT_EQ(one.judged().verdict, Verdict::not_confirmed);
  EXPECT_THAT(one.judged().reason, HasSubstr("Too few runs: b has 2, 5 are needed."));
}

TEST(CountClaims, AreComparedWithAPublishedCount) {
  OneClaim one(ClaimKind::count, 20, std::vector<double>(20, 1.0));
  one.claim().threshold = 4.0;
  one.claim().runs = 20;
  one.claim().successes = 0;
  const auto with_successes = [&one](int count) {
    for (int i = 0; i < 20; ++i)
      one.data.records[static_cast<std::size_t>(i)].best_objective = i < count ? 5.0 : 1.0;
    return one.judged().verdict;
  };
  EXPECT_EQ(with_successes(0), Verdict::compatible) << "one in six would go unseen in 20";
  EXPECT_EQ(with_successes(1), Verdict::not_confirmed) << "0 of 20 is outside the interval of 1 of 20";
  EXPECT_EQ(with_successes(4), Verdict::not_confirmed) << "Fisher: p = 0.106";
  EXPECT_EQ(with_successes(5), Verdict::contradicted) << "Fisher: p = 0.047";
  one.claim().successes = 5;
  EXPECT_EQ(with_successes(2), Verdict::compatible);
  EXPECT_EQ(with_successes(9), Verdict::compatible);
  EXPECT_EQ(with_successes(12), Verdict::not_confirmed);
  EXPECT_EQ(with_successes(15), Verdict::contradicted);
}

TEST(CountClaims, OfFewRunsAreNeitherConfirmedNorContradicted) {
  OneClaim one(ClaimKind::count, 2, {5.0, 5.0});
  one.claim().threshold = 4.0;
  one.claim().runs = 20;
  for (const int successes : {0, 1, 10, 20}) {
    one.claim().successes = successes;
    EXPECT_EQ(one.judged().verdict, Verdict::not_confirmed) << "two of two say little";
    EXPECT_THAT(one.judged().reason, HasSubstr("Too few runs: a has 2, 5 are needed."));
  }
}

TEST(GaitClaims, LookAtTheGaitsOfATest) {
  OneClaim one(ClaimKind::gaits, 5, {1.0, 1.0, 1.0, 1.0, 1.0});
  one.data.study.tests.resize(1);
  one.data.study.tests[0].name = one.claim().measure = "long";
  const char* gaits[] = {"pace", "irregular", "", "", "irregular"};
  for (std::size_t i = 0; i < 5; ++i)
    add_test(one.data.records[i], "long", 1.0, 300.0, 300.0, 300.0, gaits[i]);
  one.claim().only = {"pace"};
  EXPECT_EQ(one.judged().verdict, Verdict::confirmed) << "irregular and nameless gaits are no gaits";
  EXPECT_EQ(one.judged().ours, "pace 1, irregular 2, no name 2");
  one.claim().only = {"trot"};
  EXPECT_EQ(one.judged().verdict, Verdict::contradicted);
  EXPECT_EQ(one.judged().reason, "Besides: pace.");
  one.claim().only.clear();
  one.claim().includes = {"pace", "trot"};
  EXPECT_EQ(one.judged().verdict, Verdict::contradicted);
  EXPECT_EQ(one.judged().reason, "Absent: trot.");
  one.data.records[0].tests[0].gait = "irregular";
  EXPECT_EQ(one.judged().verdict, Verdict::not_confirmed);
  for (auto& run : one.data.records) run.tests.clear();
  EXPECT_EQ(one.judged().verdict, Verdict::not_testable);
}

TEST(GaitCounts, AreInTheOrderOfTheDocumentation) {
  StudyData data{.study = sample_study({"a"}, 5), .records = {}, .unknown_files = {}};
  data.study.tests.resize(1);
  data.study.tests[0].name = "long";
  add_runs(data, "a", {1.0, 1.0, 1.0, 1.0, 1.0});
  const char* gaits[] = {"irregular", "", "pace", "walk diagonal", "pace"};
  for (std::size_t i = 0; i < 5; ++i) add_test(data.records[i], "long", 1.0, 300.0, 300.0, 300.0, gaits[i]);
  const auto tables = gait_tables(data);
  ASSERT_EQ(tables.size(), 1u);
  EXPECT_THAT(tables[0].gaits, ElementsAre("walk diagonal", "pace", "irregular", "no name"));
  EXPECT_THAT(tables[0].rows.at(0).runs, ElementsAre(Pair("walk diagonal", 1), Pair("pace", 2),
                                                     Pair("irregular", 1), Pair("no name", 1)));
  EXPECT_EQ(tables[0].rows[0].n, 5u);
}

}  // namespace
}  // namespace amble::report
