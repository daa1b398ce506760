#include "amble/report/verdict_rules.hpp"

#include <gtest/gtest.h>

namespace amble::report {
namespace {

using ledger::Relation;
using statistics::Direction;
constexpr double none = ledger::unbounded;

TEST(DifferenceRule, GreaterNeedsDirectionAndSignificance) {
  const auto verdict = [](Direction direction, double p) {
    return difference_verdict(Relation::greater, direction, p, 0.05);
  };
  EXPECT_EQ(verdict(Direction::greater, 0.049), Verdict::confirmed);
  EXPECT_EQ(verdict(Direction::greater, 0.05), Verdict::not_confirmed) << "the level itself is not below it";
  EXPECT_EQ(verdict(Direction::less, 0.05), Verdict::not_confirmed);
  EXPECT_EQ(verdict(Direction::less, 0.049), Verdict::contradicted);
  EXPECT_EQ(verdict(Direction::equal, 1.0), Verdict::not_confirmed);
}

TEST(DifferenceRule, NotLessIsConfirmedAndContradictedOnlyBySignificance) {
  const auto verdict = [](Direction direction, double p) {
    return difference_verdict(Relation::not_less, direction, p, 0.01);
  };
  EXPECT_EQ(verdict(Direction::greater, 0.0099), Verdict::confirmed) << "better is not worse";
  EXPECT_EQ(verdict(Direction::greater, 0.01), Verdict::compatible) << "a sign is no test";
  EXPECT_EQ(verdict(Direction::equal, 1.0), Verdict::compatible);
  EXPECT_EQ(verdict(Direction::less, 0.01), Verdict::not_confirmed);
  EXPECT_EQ(verdict(Direction::less, 0.0099), Verdict::contradicted);
}

TEST(DifferenceRule, NotLessByMoreThanAMarginNeedsATestOfIt) {
  for (const auto direction : {Direction::greater, Direction::equal, Direction::less}) {
    EXPECT_EQ(difference_verdict(Relation::not_less, direction, 0.5, 0.05, true), Verdict::confirmed);
    EXPECT_NE(difference_verdict(Relation::greater, direction, 0.5, 0.05, true), Verdict::confirmed)
        << "no worse is not better";
  }
}

TEST(BoundsRule, BoundsBelongToTheClaimedRange) {
  EXPECT_EQ(bounds_verdict({2.0, 3.0}, 2.0, none), Verdict::confirmed);
  EXPECT_EQ(bounds_verdict({1.99, 3.0}, 2.0, none), Verdict::not_confirmed);
  EXPECT_EQ(bounds_verdict({1.0, 2.0}, 2.0, none), Verdict::not_confirmed) << "its upper end is in the range";
  EXPECT_EQ(bounds_verdict({1.0, 1.99}, 2.0, none), Verdict::contradicted);
  EXPECT_EQ(bounds_verdict({1.0, 3.0}, -none, 3.0), Verdict::confirmed);
  EXPECT_EQ(bounds_verdict({3.01, 4.0}, -none, 3.0), Verdict::contradicted);
}

TEST(BoundsRule, ARangeHasTwoSides) {
  EXPECT_EQ(bounds_verdict({1.2, 1.5}, 1.18, 1.54), Verdict::confirmed);
  EXPECT_EQ(bounds_verdict({1.0, 1.1}, 1.18, 1.54), Verdict::contradicted);
  EXPECT_EQ(bounds_verdict({1.6, 1.7}, 1.18, 1.54), Verdict::contradicted);
  EXPECT_EQ(bounds_verdict({1.0, 2.0}, 1.18, 1.54), Verdict::not_confirmed) << "it spans the range";
  EXPECT_EQ(bounds_verdict({1.3, 1.6}, 1.18, 1.54), Verdict::not_confirmed);
}

TEST(AgreementRule, LackOfSignificanceIsCompatibleAtBest) {
  const auto verdict = [](double p, bool inside, bool spreads_differ, bool equivalent) {
    return agreement_verdict({p, 0.05, inside, spreads_differ, equivalent});
  };
  EXPECT_EQ(verdict(0.05, true, false, false), Verdict::compatible);
  EXPECT_EQ(verdict(0.9, false, false, false), Verdict::not_confirmed);
  EXPECT_EQ(verdict(0.9, true, true, false), Verdict::not_confirmed)
      << "the mean is half of what was printed";
  EXPECT_EQ(verdict(0.9, true, true, true), Verdict::not_confirmed);
  EXPECT_EQ(verdict(0.9, false, false, true), Verdict::not_confirmed);
  EXPECT_EQ(verdict(0.9, true, false, true), Verdict::confirmed) << "equivalence is evidence";
  for (const bool any : {false, true}) EXPECT_EQ(verdict(0.049, any, !any, any), Verdict::contradicted);
}

TEST(CountRule, DecidesOnceMissingRunsCannotChangeIt) {
  EXPECT_EQ(count_verdict(1, 0, 1, none), Verdict::confirmed);
  EXPECT_EQ(count_verdict(0, 0, 1, none), Verdict::contradicted);
  EXPECT_EQ(count_verdict(1, 5, 1, none), Verdict::confirmed) << "more successes keep it";
  EXPECT_EQ(count_verdict(0, 5, 1, none), Verdict::not_testable);
  EXPECT_EQ(count_verdict(0, 5, 6, none), Verdict::contradicted) << "five more are not enough";
  EXPECT_EQ(count_verdict(0, 0, -none, 0), Verdict::confirmed);
  EXPECT_EQ(count_verdict(0, 1, -none, 0), Verdict::not_testable);
  EXPECT_EQ(count_verdict(1, 1, -none, 0), Verdict::contradicted);
  EXPECT_EQ(count_verdict(3, 2, 2, 5), Verdict::confirmed);
  EXPECT_EQ(count_verdict(3, 3, 2, 5), Verdict::not_testable);
}

TEST(GaitsRule, AWalkIsEitherWalk) {
  EXPECT_TRUE(is_gait("walk lateral", "walk"));
  EXPECT_TRUE(is_gait("walk diagonal", "walk"));
  EXPECT_TRUE(is_gait("walk lateral", "walk lateral"));
  EXPECT_FALSE(is_gait("walk lateral", "walk diagonal"));
  EXPECT_FALSE(is_gait("trot", "tro"));
  EXPECT_FALSE(is_gait("walk", "walk lateral"));
}

TEST(GaitsRule, IncludedGaitsMustAllOccur) {
  EXPECT_EQ(gaits_verdict({"pace", "trot", "walk lateral"}, {"pace", "trot", "walk"}, {}, false),
            Verdict::confirmed);
  EXPECT_EQ(gaits_verdict({"pace", "trot", "bound"}, {"pace", "trot", "walk"}, {}, false),
            Verdict::contradicted);
  EXPECT_EQ(gaits_verdict({}, {"pace"}, {}, false), Verdict::not_confirmed);
  EXPECT_EQ(gaits_verdict({"pace"}, {"pace"}, {}, true), Verdict::confirmed)
      << "runs to come cannot take it away";
  EXPECT_EQ(gaits_verdict({"trot"}, {"pace"}, {}, true), Verdict::not_testable);
}

TEST(GaitsRule, OnlyTheseMayOccur) {
  EXPECT_EQ(gaits_verdict({"pace"}, {}, {"pace"}, false), Verdict::confirmed);
  EXPECT_EQ(gaits_verdict({"pace", "trot"}, {}, {"pace"}, false), Verdict::contradicted);
  EXPECT_EQ(gaits_verdict({"pace", "trot"}, {}, {"pace"}, true), Verdict::contradicted);
  EXPECT_EQ(gaits_verdict({"pace"}, {}, {"pace"}, true), Verdict::not_testable) << "another may still occur";
  EXPECT_EQ(gaits_verdict({}, {}, {"pace"}, false), Verdict::not_confirmed);
  EXPECT_EQ(gaits_verdict({"pace"}, {"pace", "trot"}, {"pace", "trot"}, false), Verdict::contradicted);
}

TEST(BoundsRule, EachEndOfARangeCountsByItself) {
  // A sound estimate from 1 to 2, claimed to be from the first number to the second.
  struct Case {
    double at_least, at_most;
    Verdict verdict;
  };
  for (const auto& [at_least, at_most, verdict] : {Case{1.0, 2.0, Verdict::confirmed},
                                                   {1.01, 2.0, Verdict::not_confirmed},
                                                   {1.0, 1.99, Verdict::not_confirmed},
                                                   {-none, 1.0, Verdict::not_confirmed},
                                                   {-none, 0.99, Verdict::contradicted},
                                                   {2.0, none, Verdict::not_confirmed},
                                                   {2.01, none, Verdict::contradicted}})
    EXPECT_EQ(bounds_verdict({1.0, 2.0}, at_least, at_most), verdict) << at_least << " to " << at_most;
}

TEST(CountRule, BoundsBelongToTheClaim) {
  struct Case {
    std::size_t successes, missing;
    Verdict verdict;
  };
  // Claimed: from 2 to 4.
  for (const auto& [successes, missing, verdict] : {Case{2, 0, Verdict::confirmed},
                                                    {4, 0, Verdict::confirmed},
                                                    {2, 2, Verdict::confirmed},
                                                    {2, 3, Verdict::not_testable},
                                                    {1, 1, Verdict::not_testable},
                                                    {1, 0, Verdict::contradicted},
                                                    {0, 1, Verdict::contradicted},
                                                    {0, 2, Verdict::not_testable},
                                                    {4, 1, Verdict::not_testable},
                                                    {5, 0, Verdict::contradicted}})
    EXPECT_EQ(count_verdict(successes, missing, 2, 4), verdict) << successes << " and " << missing;
}

}  // namespace
}  // namespace amble::report
