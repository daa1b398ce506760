#include "amble/statistics/t_test.hpp"

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

}  // namespace
}  // namespace amble::statistics
