#include "amble/ledger/study_spec.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "amble/core/hash.hpp"
#include "amble/core/index.hpp"
#include "amble/core/random.hpp"
#include "amble/report/verdict.hpp"
#include "amble/score/walking.hpp"
#include "tests/report/fixture.hpp"

namespace amble::report {
namespace {

using ledger::ClaimKind;
using ledger::ClaimSpec;
using ledger::Relation;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const char* const what_to_do =
    "the rules' behaviour has changed: raise ledger::current_rules, list the version in docs/STUDIES.md, and "
    "pin it here beside the older ones";

ClaimSpec claim_about(ClaimKind kind, const std::string& condition, const std::string& against = {}) {
  ClaimSpec claim;
  claim.kind = kind;
  claim.text = "so it is";
  claim.condition = condition;
  claim.against = against;
  return claim;
}

std::vector<ClaimSpec> claims_of_all_verdicts() {
  std::vector<ClaimSpec> claims;
  for (const auto relation : {Relation::greater, Relation::not_less})
    for (const auto test :
         {ledger::TwoSampleTest::student, ledger::TwoSampleTest::welch, ledger::TwoSampleTest::mann_whitney})
      for (const auto& [first, second] :
           {std::pair{"far", "near"}, {"near", "far"}, {"near", "like"}, {"like", "near"}}) {
        ClaimSpec one = claim_about(ClaimKind::difference, first, second);
        one.relation = relation;
        one.test = test;
        claims.push_back(one);
        if (relation == Relation::greater || one.test == ledger::TwoSampleTest::mann_whitney) continue;
        one.margin = 0.8;
        claims.push_back(one);
      }
  for (const double mean : {4.3, 4.5, 5.5, 9.0})
    for (const double sd : {0.05, 0.5, 5.0}) {
      claims.push_back(claim_about(ClaimKind::value, "near"));
      claims.back().mean = mean;
      claims.back().sd = sd;
      claims.back().runs = 20;
    }
  for (const int successes : {0, 1, 6, 12, 20}) {
    claims.push_back(claim_about(ClaimKind::count, "near"));
    claims.back().threshold = 4.5;
    claims.back().successes = successes;
    claims.back().runs = 20;
  }
  for (const double bound : {1.0, 3.0, 30.0}) {
    claims.push_back(claim_about(ClaimKind::count, "near"));
    claims.back().threshold = 4.5;
    claims.back().at_least = bound;
  }
  for (const double ratio : {1.0, 1.5, 3.0}) {
    claims.push_back(claim_about(ClaimKind::ratio, "far", "near"));
    claims.back().at_least = ratio;
  }
  for (const double gain : {0.1, 0.9}) {
    claims.push_back(claim_about(ClaimKind::plateau, "near"));
    claims.back().from_generation = 5;
    claims.back().at_most = gain;
  }
  for (const char* gait : {"pace", "trot", "walk"}) {
    claims.push_back(claim_about(ClaimKind::gaits, "near"));
    claims.back().measure = "long";
    claims.back().includes = {gait};
    claims.push_back(claims.back());
    std::swap(claims.back().includes, claims.back().only);
  }
  return claims;
}

/// Three conditions: two that are alike and one that is ahead, of so many runs.
StudyData pinned_study(int runs) {
  StudyData data{.study = sample_study({"far", "near", "like"}, runs), .records = {}, .unknown_files = {}};
  data.study.tests.resize(1);
  data.study.tests[0].name = "long";
  for (const auto& [condition, from_m] : {std::pair{"far", 7.0}, {"near", 4.0}, {"like", 4.1}}) {
    std::vector<double> best_m;
    for (int i = 0; i < runs; ++i) best_m.push_back(from_m + 0.1 * ((7 * i) % 11));
    add_runs(data, condition, best_m);
  }
  for (ledger::Record& run : data.records)
    add_test(run, "long", 1.0, 300.0, 300.0, 300.0, run.seed % 3 == 0 ? "walk lateral" : "pace");
  data.study.claims = claims_of_all_verdicts();
  return data;
}

TEST(VerdictRules, SayWhatIsPinnedForTheirVersion) {
  // Version 1 (until the re-test) had four verdicts; what it said is in docs/verdicts-of-rules-1.csv.
  const std::map<int, std::string> pinned{{2, "68b902a594b2de61"}};
  std::string said;
  std::set<Verdict> verdicts;
  for (const int runs : {1, 2, 4, 5, 6, 20}) {
    said += fmt::format(" {} ", runs);
    for (const Judgement& judged : judge(pinned_study(runs))) {
      said += "+~o-."[to_index(judged.verdict)];
      verdicts.insert(judged.verdict);
    }
  }
  EXPECT_EQ(verdicts.size(), verdict_names.size()) << "every verdict occurs";
  ASSERT_TRUE(pinned.contains(ledger::current_rules.verdicts)) << what_to_do;
  EXPECT_EQ(hex(hash_text(said)), pinned.at(ledger::current_rules.verdicts)) << what_to_do << "\n" << said;
}

TEST(StopRule, SaysWhatIsPinnedForItsVersion) {
  const std::map<int, std::string> pinned{{1, "ff9d9d8f7ecd2c5f"}};
  Stream stream(1, Purpose::test);
  std::string said;
  for (int walk = 0; walk < 50; ++walk) {
    // Steps of a few centimetres in 0.1 s, ever shorter, in multiples of a millimetre.
    score::WalkingMeter meter({}, 0.1);
    Vec3 com_m{};
    for (int step = 1; step <= 900; ++step) {
      const double reach_m = 0.2 * (1.0 - step / 1000.0) * walk / 50.0;
      com_m.x += std::round(1000.0 * reach_m * (stream.uniform() - 0.4)) / 1000.0;
      com_m.y += std::round(1000.0 * reach_m * (stream.uniform() - 0.5)) / 1000.0;
      meter.add(com_m);
    }
    said += fmt::format("{:.1f} ", meter.walking_s());
  }
  ASSERT_TRUE(pinned.contains(ledger::current_rules.stop)) << what_to_do;
  EXPECT_EQ(hex(hash_text(said)), pinned.at(ledger::current_rules.stop)) << what_to_do << "\n" << said;
}

TEST(JudgingRules, OfARecordAreThoseOfTheHashItHolds) {
  StudyData data = small_study();
  data.study.claims[0].margin = 0.0;
  const ledger::StudySpec& study = data.study;
  EXPECT_NE(study.claims_hash(ledger::first_rules), study.claims_hash());
  EXPECT_EQ(study.rules_of(study.claims_hash()), ledger::current_rules);
  EXPECT_EQ(study.rules_of(study.claims_hash(ledger::first_rules)), ledger::first_rules);
  EXPECT_FALSE(study.rules_of("0123456789abcdef"));
  EXPECT_FALSE(study.rules_of(""));
}

TEST(JudgingRules, OlderOnesAreNamedAndDoNotCountAsOtherClaims) {
  StudyData data = small_study();
  for (std::size_t i = 0; i < 4; ++i)
    data.records[i].provenance.claims = data.study.claims_hash(ledger::first_rules);
  const ClaimsWritten written = claims_written(data);
  EXPECT_EQ(written.differently, 0u);
  EXPECT_EQ(written.under.size(), 2u);
  EXPECT_THAT(
      remarks(data),
      ElementsAre("The claims of 4 of 6 records were written under verdict rules 1 and stop rule 1 and "
                  "are judged here under verdict rules 2 and stop rule 1: the same sentences, other "
                  "rules, of which docs/STUDIES.md says what changed and why."));
  data.study.claims[0].alpha = 0.01;
  EXPECT_THAT(remarks(data), ElementsAre(HasSubstr("6 of 6 records were made when they were others")));
}

}  // namespace
}  // namespace amble::report
