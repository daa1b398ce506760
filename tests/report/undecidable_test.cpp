#include "amble/report/undecidable.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/report/fixture.hpp"

namespace amble::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

ledger::StudySpec with_claim(int seeds, ledger::ClaimSpec claim) {
  ledger::StudySpec study = sample_study({"a", "b"}, seeds);
  claim.text = "a is more than b";
  claim.condition = "a";
  claim.against = "b";
  study.claims = {claim};
  return study;
}

TEST(UndecidableClaims, AreThoseOfFewerRunsThanDecideAnything) {
  EXPECT_THAT(
      undecidable_claims(with_claim(3, {})),
      ElementsAre("claims[0], \"a is more than b\": with 3 runs of 'a' it cannot be decided; 5 are needed"));
  EXPECT_THAT(undecidable_claims(with_claim(5, {})), IsEmpty());
}

TEST(UndecidableClaims, CountTheConditionOfFewerRuns) {
  ledger::StudySpec study = with_claim(8, {});
  study.conditions[1].seeds = {1, 2};
  EXPECT_THAT(undecidable_claims(study), ElementsAre(HasSubstr("with 2 runs of 'b'")));
}

TEST(UndecidableClaims, OfRanksDependOnHowSmallPIsToBe) {
  const auto ranks = [](double alpha) {
    ledger::ClaimSpec claim;
    claim.test = ledger::TwoSampleTest::mann_whitney;
    claim.alpha = alpha;
    return claim;
  };
  EXPECT_THAT(undecidable_claims(with_claim(5, ranks(0.05))), IsEmpty());  // the smallest p is 2 of 252
  EXPECT_THAT(undecidable_claims(with_claim(5, ranks(0.001))), ElementsAre(HasSubstr("7 are needed")));
  EXPECT_THAT(undecidable_claims(with_claim(7, ranks(0.001))), IsEmpty());
}

TEST(UndecidableClaims, OfRanksMayBeTooManyToBeAdjustedTogether) {
  ledger::ClaimSpec claim;
  claim.test = ledger::TwoSampleTest::mann_whitney;
  ledger::StudySpec study = with_claim(5, claim);
  for (int more = 0; more < 5; ++more) study.claims.push_back(study.claims.front());
  EXPECT_THAT(undecidable_claims(study), IsEmpty());  // 6 × 2/252 = 0.048
  study.claims.push_back(study.claims.front());
  EXPECT_THAT(undecidable_claims(study),
              ElementsAre(HasSubstr(
                  "the 7 claims that one condition is ahead of another are adjusted together, and "
                  "with these runs the smallest p of ranks is 0.0079: none can be confirmed; 6 runs")));
  study.claims.back().relation = ledger::Relation::not_less;  // of another family
  EXPECT_THAT(undecidable_claims(study), IsEmpty());
  study.claims.back() = study.claims.front();
  study.claims.back().test = ledger::TwoSampleTest::welch;  // whose p has no least
  EXPECT_THAT(undecidable_claims(study), IsEmpty());
}

TEST(UndecidableClaims, OfPlateausNeedRunsThatGoOnAfterTheirGeneration) {
  ledger::ClaimSpec claim;
  claim.kind = ledger::ClaimKind::plateau;
  claim.from_generation = 5;
  ledger::StudySpec study = with_claim(6, claim);
  study.generations = 5;
  EXPECT_THAT(undecidable_claims(study),
              ElementsAre(HasSubstr("with 5 generations of 'a' it cannot be decided; "
                                    "from_generation = 5 needs 7")));
  study.conditions[0].generations = 6;  // the last is number 5 itself
  EXPECT_THAT(undecidable_claims(study), Not(IsEmpty()));
  study.conditions[0].generations = 7;
  EXPECT_THAT(undecidable_claims(study), IsEmpty());
  study.generations = study.conditions[0].generations = 0;  // as in the config
  EXPECT_THAT(undecidable_claims(study), IsEmpty());
}

TEST(UndecidableClaims, AreCountsByWhatNoRunCanReachOrATestIsTooShortFor) {
  ledger::ClaimSpec claim;
  claim.kind = ledger::ClaimKind::count;
  claim.at_least = 3;
  const auto line_of = [&](const std::string& measure, double threshold, double seconds) {
    claim.measure = measure;
    claim.threshold = threshold;
    ledger::StudySpec study = with_claim(6, claim);
    study.tests.resize(1);
    study.tests[0].name = "t";
    study.tests[0].seconds = seconds;
    const auto lines = undecidable_claims(study);
    return lines.empty() ? std::string() : lines.front();
  };
  EXPECT_THAT(line_of("t.upright_s", 30.0, 3.0), HasSubstr("threshold = 30: t.upright_s is at most 3"));
  EXPECT_THAT(line_of("t.fell_share", 2.0, 3.0), HasSubstr("t.fell_share is at most 1"));
  EXPECT_THAT(line_of("t.tracking", 3.0, 3.0), HasSubstr("t.tracking is at most 1"));
  EXPECT_THAT(line_of("t.walking_s", 4.0, 4.0), HasSubstr("cannot tell who stops: a stop takes 10 s"));
  EXPECT_EQ(line_of("t.walking_s", 15.0, 15.0), "");
  EXPECT_EQ(line_of("t.upright_s", 3.0, 3.0), "");
}

TEST(UndecidableClaims, CountMoreRunsThanThereAre) {
  ledger::ClaimSpec claim;
  claim.kind = ledger::ClaimKind::count;
  claim.threshold = 1.0;
  claim.at_least = 9;
  EXPECT_THAT(undecidable_claims(with_claim(6, claim)),
              ElementsAre(HasSubstr("with 6 runs of 'a' it cannot be confirmed; 9 are needed")));
  EXPECT_THAT(undecidable_claims(with_claim(9, claim)), IsEmpty());
}

TEST(UndecidableClaims, OfRatiosAndPlateausNeedARunMoreThanOthers) {
  for (const auto kind : {ledger::ClaimKind::ratio, ledger::ClaimKind::plateau}) {
    ledger::ClaimSpec claim;
    claim.kind = kind;
    EXPECT_THAT(undecidable_claims(with_claim(5, claim)), ElementsAre(HasSubstr("6 are needed")));
    EXPECT_THAT(undecidable_claims(with_claim(6, claim)), IsEmpty());
  }
}

}  // namespace
}  // namespace amble::report
