#include "amble/statistics/descriptive.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "amble/core/random.hpp"
#include "tests/statistics/oracles.hpp"

namespace amble::statistics {
namespace {

using tests::agrees;
using tests::is_near;
using tests::Json;
using tests::oracles;
using tests::Sample;

void expect_summary(const Sample& sample, const Json& expected) {
  const auto summary = summarize(sample);
  ASSERT_EQ(summary.has_value(), !expected.is_null());
  if (!summary) return;
  EXPECT_EQ(summary->n, sample.size());
  EXPECT_TRUE(is_near(summary->mean, expected["mean"]));
  EXPECT_TRUE(agrees(summary->sd, expected["sd"]));
  EXPECT_TRUE(is_near(summary->minimum, expected["minimum"]));
  EXPECT_TRUE(is_near(summary->lower_quartile, expected["lower_quartile"]));
  EXPECT_TRUE(is_near(summary->median, expected["median"]));
  EXPECT_TRUE(is_near(summary->upper_quartile, expected["upper_quartile"]));
  EXPECT_TRUE(is_near(summary->maximum, expected["maximum"]));
  EXPECT_TRUE(is_near(summary->interquartile_mean, expected["interquartile_mean"]));
  ASSERT_EQ(summary->mean_interval.has_value(), !expected["mean_interval"].is_null());
  if (!summary->mean_interval) return;
  EXPECT_TRUE(is_near(*summary->mean_interval, expected["mean_interval"][0], expected["mean_interval"][1]));
}

TEST(Summary, IsThatOfScipyAndNumpy) {
  ASSERT_GE(oracles()["samples"].size(), 20u);
  for (const auto& set : oracles()["samples"]) {
    SCOPED_TRACE(set["name"]);
    expect_summary(set["first"], set["summaries"][0]);
    expect_summary(set["second"], set["summaries"][1]);
  }
}

TEST(Summary, SaysNothingWithoutValuesAndHasNoSpreadOfOne) {
  EXPECT_FALSE(summarize({}));
  const Sample one{3.5};
  const auto summary = summarize(one);
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->mean, 3.5);
  EXPECT_EQ(summary->upper_quartile, 3.5);
  EXPECT_FALSE(summary->sd);
  EXPECT_FALSE(summary->mean_interval);
}

TEST(Summary, OfEqualValuesHasExactlyNoSpread) {
  Stream stream(1, Purpose::test);
  for (int i = 0; i < 1000; ++i) {
    const double value = stream.normal() * 1e3;
    const auto summary = summarize(Sample(2 + stream.below(40), value));
    EXPECT_EQ(summary->mean, value);
    EXPECT_EQ(summary->sd, 0.0);
    EXPECT_EQ(summary->interquartile_mean, value);
    EXPECT_EQ(summary->mean_interval->lower, summary->mean_interval->upper);
  }
}

TEST(Summary, OrdersItsNumbersAndNeedsNoOrder) {
  Stream stream(2, Purpose::test);
  for (int i = 0; i < 1000; ++i) {
    Sample sample(1 + stream.below(30));
    for (double& x : sample) x = stream.normal();
    const auto a = *summarize(sample);
    EXPECT_LE(a.minimum, a.lower_quartile);
    EXPECT_LE(a.lower_quartile, a.median);
    EXPECT_LE(a.median, a.upper_quartile);
    EXPECT_LE(a.upper_quartile, a.maximum);
    EXPECT_LE(a.minimum, a.interquartile_mean);
    EXPECT_LE(a.interquartile_mean, a.maximum);
    std::ranges::reverse(sample);
    const auto b = *summarize(sample);
    EXPECT_EQ(a.median, b.median);
    EXPECT_EQ(a.interquartile_mean, b.interquartile_mean);
    EXPECT_NEAR(a.mean, b.mean, 1e-14);
  }
}

TEST(InterquartileMean, IsTheMeanOfTheMiddleHalf) {
  EXPECT_EQ(interquartile_mean(Sample{100.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, -100.0}), 3.5);
  EXPECT_EQ(interquartile_mean(Sample{0.0, 3.0, 9.0}), 4.0);
  // Five values lose one at each end, as in SciPy, and not 1.25.
  EXPECT_EQ(interquartile_mean(Sample{0.0, 1.0, 2.0, 6.0, 100.0}), 3.0);
}

TEST(Quantile, InterpolatesBetweenOrderStatistics) {
  const Sample sample{40.0, 10.0, 20.0};
  EXPECT_EQ(quantile(sample, 0.0), 10.0);
  EXPECT_EQ(quantile(sample, 0.25), 15.0);
  EXPECT_EQ(quantile(sample, 0.75), 30.0);
  EXPECT_EQ(quantile(sample, 1.0), 40.0);
}

TEST(Median, IsTheMiddleOneOrTheMeanOfTheTwoInTheMiddle) {
  EXPECT_EQ(median(Sample{4.0}), 4.0);
  EXPECT_EQ(median(Sample{9.0, -1.0, 2.0}), 2.0);
  EXPECT_EQ(median(Sample{8.0, 1.0, 3.0, 2.0}), 2.5);
}

TEST(MeanInterval, IsWiderForMoreConfidence) {
  const Moments sample{20, 5.0, 2.0};
  const auto narrow = mean_interval(sample, 0.5), wide = mean_interval(sample, 0.99);
  EXPECT_LT(wide->lower, narrow->lower);
  EXPECT_GT(wide->upper, narrow->upper);
  EXPECT_FALSE(mean_interval({1, 5.0, 0.0}));
}

TEST(DescriptiveDeathTest, RefusesWhatIsNoNumber) {
  const Sample sample{1.0, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_DEATH(summarize(sample), "finite values only");
  EXPECT_DEATH(moments(sample), "finite values only");
  EXPECT_DEATH(mean({}), "a mean needs a value");
  EXPECT_DEATH(median({}), "needs a value");
}

}  // namespace
}  // namespace amble::statistics
