#include "amble/statistics/agreement.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "amble/core/random.hpp"
#include "tests/statistics/oracles.hpp"

namespace amble::statistics {
namespace {

using tests::is_near;
using tests::Json;
using tests::oracles;
using tests::Sample;

Moments read(const Json& triple) {
  return {triple[2].get<std::size_t>(), triple[0].get<double>(), triple[1].get<double>()};
}

TEST(FTestOfVariances, IsThatOfScipysDistribution) {
  for (const auto& pair : oracles()["agreements"]) {
    SCOPED_TRACE(pair.dump());
    const auto test = *f_test(read(pair["first"]), read(pair["second"]));
    EXPECT_TRUE(is_near(test.ratio, pair["f"]["ratio"]));
    EXPECT_TRUE(is_near(test.p, pair["f"]["p"]));
    const auto back = *f_test(read(pair["second"]), read(pair["first"]));
    EXPECT_NEAR(back.p, test.p, 1e-12) << "the same the other way round";
  }
}

TEST(FTestOfVariances, SaysNothingWithTooFewValuesOrWithoutSpread) {
  EXPECT_FALSE(f_test({1, 0.0, 0.0}, {20, 0.0, 1.0}));
  EXPECT_FALSE(f_test({20, 0.0, 0.0}, {20, 1.0, 0.0}));
  EXPECT_EQ(f_test({20, 0.0, 0.0}, {20, 1.0, 2.0})->p, 0.0);
  EXPECT_EQ(f_test({20, 0.0, 2.0}, {20, 1.0, 0.0})->p, 0.0);
  EXPECT_EQ(f_test({20, 0.0, 2.0}, {20, 1.0, 2.0})->p, 1.0);
}

TEST(EquivalenceTest, IsThatOfScipyOnShiftedMeans) {
  for (const auto& pair : oracles()["agreements"]) {
    SCOPED_TRACE(pair.dump());
    const double margin = pair["margin"].get<double>();
    const Moments first = read(pair["first"]), second = read(pair["second"]);
    for (const auto& [name, test] : {std::pair{"student", *student_t_test(first, second)},
                                     std::pair{"welch", *welch_t_test(first, second)}}) {
      const auto& one_sided = pair[name];
      EXPECT_TRUE(is_near(non_inferiority_p(test, margin), one_sided[0]));
      const auto& larger =
          one_sided[0].get<double>() > one_sided[1].get<double>() ? one_sided[0] : one_sided[1];
      EXPECT_TRUE(is_near(equivalence_p(test, margin), larger));
    }
  }
}

TEST(EquivalenceTest, IsSignificantWhereTheIntervalLiesWithinTheMargin) {
  Stream stream(5, Purpose::test);
  int within = 0;
  for (int i = 0; i < 2000; ++i) {
    Sample a(3 + stream.below(20)), b(3 + stream.below(20));
    for (double& x : a) x = stream.normal();
    for (double& x : b) x = 0.3 + stream.normal();
    const double alpha = 0.05, margin = 1.5 * stream.uniform();
    const auto test = *welch_t_test(a, b, 1.0 - alpha);
    const bool inside = test.interval.lower > -margin && test.interval.upper < margin;
    EXPECT_EQ(equivalence_p(test, margin) < alpha / 2.0, inside);
    EXPECT_EQ(non_inferiority_p(test, margin) < alpha / 2.0, test.interval.lower > -margin);
    within += inside;
  }
  EXPECT_GT(within, 100);
  EXPECT_LT(within, 1900);
}

TEST(EquivalenceTest, RarelyCallsADifferenceOfTheMarginEquivalent) {
  // At the border of the margin the test at level 0.05 is right about 19 times in 20, or more often.
  Stream stream(6, Purpose::test);
  int wrong = 0;
  const int studies = 4000;
  for (int i = 0; i < studies; ++i) {
    Sample a(20), b(20);
    for (double& x : a) x = stream.normal();
    for (double& x : b) x = 1.0 + stream.normal();
    wrong += equivalence_p(*student_t_test(a, b), 1.0) < 0.05;
  }
  EXPECT_NEAR(wrong / static_cast<double>(studies), 0.05, 0.012);
}

}  // namespace
}  // namespace amble::statistics
