#include "amble/statistics/hypothesis_tests.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "amble/core/random.hpp"
#include "tests/statistics/oracles.hpp"

namespace amble::statistics {
namespace {

using tests::is_near;
using tests::Json;
using tests::oracles;
using tests::Sample;

void expect_test(const std::optional<TTest>& test, const Json& expected) {
  ASSERT_EQ(test.has_value(), !expected.is_null());
  if (!test) return;
  EXPECT_TRUE(is_near(test->t, expected["t"]));
  EXPECT_TRUE(is_near(test->degrees_of_freedom, expected["degrees_of_freedom"]));
  EXPECT_TRUE(is_near(test->p, expected["p"]));
  EXPECT_TRUE(is_near(test->interval, expected["lower"], expected["upper"]));
  EXPECT_EQ(test->direction, direction_of(expected["t"].get<double>()));
}

TEST(StudentTTest, IsThatOfScipy) {
  for (const auto& set : oracles()["samples"]) {
    SCOPED_TRACE(set["name"]);
    expect_test(student_t_test(Sample(set["first"]), Sample(set["second"])), set["tests"]["student"]);
  }
}

TEST(WelchTTest, IsThatOfScipy) {
  for (const auto& set : oracles()["samples"]) {
    SCOPED_TRACE(set["name"]);
    expect_test(welch_t_test(Sample(set["first"]), Sample(set["second"])), set["tests"]["welch"]);
  }
}

TEST(WelchTTest, ComparesWithPublishedMomentsAsScipyDoes) {
  const auto read = [](const Json& triple) {
    return Moments{triple[2].get<std::size_t>(), triple[0].get<double>(), triple[1].get<double>()};
  };
  for (const auto& pair : oracles()["published"]) {
    SCOPED_TRACE(pair.dump());
    expect_test(welch_t_test(read(pair["first"]), read(pair["second"])), pair["welch"]);
  }
}

TEST(TTest, SaysNothingWithTooFewValuesOrWithoutSpread) {
  const Sample none, one{1.0}, two{1.0, 2.0}, equal{3.0, 3.0, 3.0}, other{4.0, 4.0};
  for (const auto test :
       {static_cast<std::optional<TTest> (*)(std::span<const double>, std::span<const double>, double)>(
            student_t_test),
        static_cast<std::optional<TTest> (*)(std::span<const double>, std::span<const double>, double)>(
            welch_t_test)}) {
    EXPECT_FALSE(test(none, two, 0.95));
    EXPECT_FALSE(test(two, one, 0.95));
    EXPECT_FALSE(test(equal, equal, 0.95));
    EXPECT_FALSE(test(equal, other, 0.95));
    EXPECT_TRUE(test(two, equal, 0.95));
  }
}

TEST(TTest, MirrorsWhenTheSamplesAreExchangedAndItsIntervalKnowsItsP) {
  Stream stream(3, Purpose::test);
  for (int i = 0; i < 1000; ++i) {
    Sample a(2 + stream.below(20)), b(2 + stream.below(20));
    for (double& x : a) x = stream.normal();
    for (double& x : b) x = 0.7 + 2.0 * stream.normal();
    const auto there = *welch_t_test(a, b), back = *welch_t_test(b, a);
    EXPECT_NEAR(there.t, -back.t, 1e-12 * std::abs(there.t));
    EXPECT_NEAR(there.p, back.p, 1e-12);
    // The interval at confidence 1 − p ends at 0.
    const auto at_p = *welch_t_test(a, b, 1.0 - there.p);
    const double end = there.t > 0.0 ? at_p.interval.lower : at_p.interval.upper;
    EXPECT_NEAR(end, 0.0, 1e-9);
    EXPECT_EQ(there.p < 0.05, !there.interval.contains(0.0));
  }
}

TEST(TTest, OfStudentAndWelchAgreeForEqualSizesAndSpreads) {
  const Moments a{10, 1.0, 2.0}, b{10, 3.0, 2.0};
  EXPECT_NEAR(student_t_test(a, b)->t, welch_t_test(a, b)->t, 1e-14);
  EXPECT_NEAR(welch_t_test(a, b)->degrees_of_freedom, 18.0, 1e-12);
}

using tests::is_near;
using tests::oracles;
using tests::Sample;

TEST(MannWhitney, IsThatOfScipy) {
  for (const auto& set : oracles()["samples"]) {
    SCOPED_TRACE(set["name"]);
    const Sample first = set["first"], second = set["second"];
    const auto& expected = set["tests"]["mann_whitney"];
    const auto test = mann_whitney(first, second);
    ASSERT_EQ(test.has_value(), !expected.is_null());
    if (!test) continue;
    EXPECT_EQ(test->u1, expected["u1"].get<double>());
    EXPECT_EQ(test->u1 + test->u2, static_cast<double>(first.size() * second.size()));
    EXPECT_EQ(test->direction, direction_of(test->u1 - test->u2));
    EXPECT_TRUE(is_near(test->p, expected["p"]));
    const auto asymptotic = mann_whitney(first, second, MannWhitneyMethod::asymptotic);
    EXPECT_TRUE(is_near(asymptotic->p, expected["asymptotic_p"]));
    if (expected.contains("exact_p")) {
      const auto exact = mann_whitney(first, second, MannWhitneyMethod::exact);
      EXPECT_TRUE(is_near(exact->p, expected["exact_p"]));
    }
  }
}

/// All choices of n1 of the first n1 + n2 whole numbers, counted.
double p_by_enumeration(const Sample& first, std::size_t n2) {
  const std::size_t n1 = first.size(), n = n1 + n2;
  const double centre = 0.5 * static_cast<double>(n1 * n2);
  const auto u_of = [&](auto is_first) {
    double u = 0.0;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < i; ++j) u += is_first(i) && !is_first(j) ? 1.0 : 0.0;
    return u;
  };
  unsigned seen_bits = 0;
  for (const double x : first) seen_bits |= 1u << static_cast<unsigned>(x);
  const double seen = std::abs(u_of([&](std::size_t i) { return (seen_bits >> i & 1u) != 0; }) - centre);
  double all = 0.0, as_extreme = 0.0;
  for (unsigned bits = 0; bits < 1u << n; ++bits) {
    if (std::popcount(bits) != static_cast<int>(n1)) continue;
    all += 1.0;
    const double u = u_of([&](std::size_t i) { return (bits >> i & 1u) != 0; });
    if (std::abs(u - centre) >= seen) as_extreme += 1.0;
  }
  return as_extreme / all;
}

TEST(MannWhitney, IsExactAsAllArrangementsCounted) {
  Stream stream(4, Purpose::test);
  for (int i = 0; i < 60; ++i) {
    const std::size_t n1 = 1 + stream.below(5), n2 = 1 + stream.below(5);
    Sample first, second;
    for (std::size_t value = 0; value < n1 + n2; ++value) {
      const bool to_first = first.size() < n1 && (second.size() == n2 || stream.chance(0.5));
      (to_first ? first : second).push_back(static_cast<double>(value));
    }
    const auto test = mann_whitney(first, second);
    EXPECT_TRUE(test->exact);
    EXPECT_NEAR(test->p, p_by_enumeration(first, n2), 1e-13);
  }
}

TEST(MannWhitney, IsExactOnlyForSmallSamplesWithoutTies) {
  const auto first_of = [](int n, double offset) {
    Sample sample;
    for (int i = 0; i < n; ++i) sample.push_back(i + offset);
    return sample;
  };
  EXPECT_TRUE(mann_whitney(first_of(8, 0.0), first_of(20, 0.5))->exact);
  EXPECT_FALSE(mann_whitney(first_of(9, 0.0), first_of(9, 0.5))->exact);
  EXPECT_FALSE(mann_whitney(first_of(3, 0.0), first_of(3, 0.0))->exact);
}

TEST(MannWhitney, CannotBeSmallerThanItsSmallestP) {
  for (int n1 = 1; n1 <= 8; ++n1) {
    for (int n2 = 1; n2 <= 8; ++n2) {
      Sample low, high;
      for (int i = 0; i < n1; ++i) low.push_back(i);
      for (int i = 0; i < n2; ++i) high.push_back(100 + i);
      const double least = smallest_mann_whitney_p(low.size(), high.size());
      EXPECT_NEAR(mann_whitney(low, high)->p, least, 1e-14);
      EXPECT_EQ(mann_whitney(low, high)->direction, Direction::less);
    }
  }
  EXPECT_NEAR(smallest_mann_whitney_p(3, 3), 0.1, 1e-15);
  EXPECT_EQ(smallest_mann_whitney_p(1, 1), 1.0);
}

TEST(MannWhitney, SeesRanksOnlyAndMirrors) {
  Stream stream(5, Purpose::test);
  for (int i = 0; i < 500; ++i) {
    Sample a(1 + stream.below(25)), b(1 + stream.below(25));
    for (auto* sample : {&a, &b})
      for (double& x : *sample) x = static_cast<double>(stream.below(30));
    const auto test = *mann_whitney(a, b), back = *mann_whitney(b, a);
    EXPECT_EQ(test.p, back.p);
    EXPECT_EQ(test.u1, back.u2);
    const auto effect = *vargha_delaney(a, b), mirrored = *vargha_delaney(b, a);
    EXPECT_NEAR(effect.a12, 1.0 - mirrored.a12, 1e-15);
    EXPECT_NEAR(effect.interval.lower, 1.0 - mirrored.interval.upper, 1e-12);
    for (auto* sample : {&a, &b})
      for (double& x : *sample) x = std::exp(0.3 * x) - 7.0;
    EXPECT_EQ(mann_whitney(a, b)->p, test.p);
    EXPECT_EQ(vargha_delaney(a, b)->a12, effect.a12);
  }
}

TEST(MannWhitney, SaysNothingOfAnEmptySampleAndFindsNothingInEqualValues) {
  const Sample none, some{1.0, 1.0, 1.0};
  EXPECT_FALSE(mann_whitney(none, some));
  EXPECT_FALSE(vargha_delaney(some, none));
  EXPECT_EQ(mann_whitney(some, some)->p, 1.0);
  EXPECT_EQ(mann_whitney(some, some)->direction, Direction::equal);
  EXPECT_EQ(vargha_delaney(some, some)->a12, 0.5);
}

TEST(MannWhitney, RanksInfinityAboveAllNumbersAndEqualToItself) {
  const double infinity = std::numeric_limits<double>::infinity();
  const Sample with{1.0, 5.0, infinity}, against{2.0, infinity, infinity, 3.0};
  const Sample large{1.0, 5.0, 9.0}, other{2.0, 9.0, 9.0, 3.0};
  EXPECT_EQ(mann_whitney(with, against)->p, mann_whitney(large, other)->p);
  EXPECT_EQ(mann_whitney(with, against)->u1, mann_whitney(large, other)->u1);
  EXPECT_EQ(vargha_delaney(with, against)->a12, vargha_delaney(large, other)->a12);
}

TEST(MannWhitneyDeathTest, RanksNoNaN) {
  const Sample bad{1.0, std::nan("")}, good{1.0, 2.0};
  EXPECT_DEATH(mann_whitney(good, bad), "are numbers");
  EXPECT_DEATH(vargha_delaney(bad, good), "are numbers");
}

TEST(MannWhitneyDeathTest, IsNotExactWithTies) {
  const Sample tied{1.0, 2.0};
  EXPECT_DEATH(mann_whitney(tied, tied, MannWhitneyMethod::exact), "knows no ties");
}

TEST(VarghaDelaney, AgreesWithItsTwinThatCountsPairsAndFindsRoots) {
  for (const auto& set : oracles()["samples"]) {
    SCOPED_TRACE(set["name"]);
    const auto effect = vargha_delaney(Sample(set["first"]), Sample(set["second"]));
    const auto& expected = set["tests"]["a12"];
    ASSERT_EQ(effect.has_value(), !expected.is_null());
    if (!effect) continue;
    EXPECT_TRUE(is_near(effect->a12, expected["a12"]));
    EXPECT_TRUE(is_near(effect->interval, expected["lower"], expected["upper"]));
  }
}

TEST(VarghaDelaney, StaysUncertainWhereAllOfOneExceedAllOfTheOther) {
  const Sample low{1.0, 2.0, 3.0, 4.0}, high{5.0, 6.0, 7.0, 8.0};
  const auto effect = *vargha_delaney(high, low);
  EXPECT_EQ(effect.a12, 1.0);
  EXPECT_EQ(effect.interval.upper, 1.0);
  EXPECT_GT(effect.interval.lower, 0.4);
  EXPECT_LT(effect.interval.lower, 0.9);
}

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

TEST(Holm, IsThatOfR) {
  ASSERT_GE(tests::oracles()["families"].size(), 20u);
  for (const auto& family : tests::oracles()["families"]) {
    const auto adjusted = holm(tests::Sample(family["p"]));
    ASSERT_EQ(adjusted.size(), family["holm"].size());
    for (std::size_t i = 0; i < adjusted.size(); ++i)
      EXPECT_TRUE(tests::is_near(adjusted[i], family["holm"][i]));
  }
  EXPECT_TRUE(holm({}).empty());
}

TEST(Holm, LiesBetweenTheValueAndBonferronisAndKeepsTheOrder) {
  Stream stream(6, Purpose::test);
  for (int i = 0; i < 1000; ++i) {
    tests::Sample p(1 + stream.below(20));
    for (double& value : p) value = stream.uniform() * stream.uniform();
    const auto adjusted = holm(p);
    for (std::size_t a = 0; a < p.size(); ++a) {
      EXPECT_GE(adjusted[a], p[a]);
      EXPECT_LE(adjusted[a], std::min(1.0, static_cast<double>(p.size()) * p[a]));
      for (std::size_t b = 0; b < p.size(); ++b) {
        if (p[a] < p[b]) {
          EXPECT_LE(adjusted[a], adjusted[b]);
        }
      }
    }
  }
}

TEST(HolmDeathTest, RefusesWhatIsNoProbability) {
  EXPECT_DEATH(holm(tests::Sample{0.5, 1.5}), "between 0 and 1");
}

}  // namespace

}  // namespace amble::statistics
