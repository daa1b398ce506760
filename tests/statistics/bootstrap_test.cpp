#include "amble/statistics/bootstrap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "amble/core/random.hpp"
#include "amble/statistics/descriptive.hpp"
#include "tests/statistics/oracles.hpp"

namespace amble::statistics {
namespace {

using tests::is_near;
using tests::Json;
using tests::oracles;
using tests::Sample;

const std::map<std::string, Statistic> by_name{
    {"mean", mean}, {"median", median}, {"interquartile_mean", interquartile_mean}};

BootstrapOptions oracle_options() {
  return {.seed = oracles()["seed"].get<std::uint64_t>(),
          .resamples = oracles()["resamples"].get<std::uint32_t>()};
}

void expect_interval(const std::optional<BootstrapInterval>& result, const Json& expected) {
  ASSERT_TRUE(result);
  EXPECT_EQ(result->degenerate, expected["degenerate"].get<bool>());
  // make_oracles rounds statistics to 12 digits of this scale.
  const double rounding = 1e-12 * expected["scale"].get<double>();
  EXPECT_TRUE(is_near(result->estimate, expected["estimate"], rounding));
  EXPECT_TRUE(is_near(result->interval, expected["lower"], expected["upper"], rounding));
  EXPECT_TRUE(is_near(result->standard_error, expected["standard_error"], rounding));
}

TEST(Bootstrap, OfOneSampleIsThatOfScipyOnTheSameResamples) {
  int compared = 0;
  for (const auto& set : oracles()["samples"]) {
    for (int i = 0; i < 2; ++i) {
      const auto& summary = set["summaries"][static_cast<std::size_t>(i)];
      if (summary.is_null()) continue;
      const Sample sample = set[i == 0 ? "first" : "second"];
      for (const auto& [name, expected] : summary["bootstrap"].items()) {
        SCOPED_TRACE(set["name"].dump() + " " + std::to_string(i) + " " + name);
        expect_interval(bootstrap(sample, by_name.at(name), oracle_options()), expected);
        ++compared;
      }
    }
  }
  EXPECT_GE(compared, 100);
}

TEST(Bootstrap, OfTwoSamplesIsThatOfScipyOnTheSameResamples) {
  int compared = 0;
  for (const auto& set : oracles()["samples"]) {
    const Sample first = set["first"], second = set["second"];
    for (const auto& [name, expected] : set["tests"]["bootstrap"].items()) {
      SCOPED_TRACE(set["name"].dump() + " " + name);
      ++compared;
      if (name == "mean_ratio") {
        expect_interval(bootstrap_ratio(first, second, mean, oracle_options()), expected);
      } else if (name == "paired_ratio") {
        expect_interval(bootstrap_paired_ratio(second, first, oracle_options()), expected);
      } else {
        const auto& statistic = by_name.at(name.substr(0, name.rfind("_difference")));
        expect_interval(bootstrap_difference(first, second, statistic, oracle_options()), expected);
      }
    }
  }
  EXPECT_GE(compared, 60);
}

Sample random_sample(Stream& stream, std::size_t n) {
  Sample sample(n);
  for (double& x : sample) x = std::exp(stream.normal());
  return sample;
}

bool same_bits(const BootstrapInterval& a, const BootstrapInterval& b) {
  return a.estimate == b.estimate && a.interval.lower == b.interval.lower &&
         a.interval.upper == b.interval.upper && a.standard_error == b.standard_error &&
         a.bias_correction == b.bias_correction && a.acceleration == b.acceleration;
}

TEST(Bootstrap, RepeatsToTheBitInAnyOrderOfTheSample) {
  Stream stream(12, Purpose::test);
  for (int i = 0; i < 20; ++i) {
    Sample a = random_sample(stream, 20), b = random_sample(stream, 17);
    const BootstrapOptions options{.seed = 3, .resamples = 500};
    const auto one = *bootstrap(a, mean, options);
    const auto two = *bootstrap_difference(a, b, interquartile_mean, options);
    const auto pairs = *bootstrap_paired_ratio(std::span(a).first(17), b, options);
    EXPECT_TRUE(same_bits(one, *bootstrap(a, mean, options)));
    const Sample a_before = a;
    std::ranges::reverse(a);
    EXPECT_TRUE(same_bits(one, *bootstrap(a, mean, options)));
    EXPECT_TRUE(same_bits(two, *bootstrap_difference(a, b, interquartile_mean, options)));
    Sample reversed_b = b, paired_a(a_before.begin(), a_before.begin() + 17);
    std::ranges::reverse(reversed_b);
    std::ranges::reverse(paired_a);
    EXPECT_TRUE(same_bits(pairs, *bootstrap_paired_ratio(paired_a, reversed_b, options)));
    EXPECT_FALSE(same_bits(one, *bootstrap(a, mean, {.seed = 4, .resamples = 500})));
  }
}

TEST(Bootstrap, FollowsShiftAndScale) {
  Stream stream(13, Purpose::test);
  const Sample sample = random_sample(stream, 20);
  Sample moved = sample;
  for (double& x : moved) x = 4.0 * x + 16.0;
  for (const auto& [name, statistic] : by_name) {
    const auto a = *bootstrap(sample, statistic), b = *bootstrap(moved, statistic);
    EXPECT_NEAR(b.interval.lower, 4.0 * a.interval.lower + 16.0, 1e-10) << name;
    EXPECT_NEAR(b.interval.upper, 4.0 * a.interval.upper + 16.0, 1e-10) << name;
    EXPECT_TRUE(a.interval.contains(a.estimate)) << name;
  }
}

TEST(Bootstrap, TakesTenThousandResamplesByDefault) {
  int calls = 0;
  const Sample sample{1.0, 2.0, 4.0, 7.0};
  bootstrap(sample, [&](std::span<const double> resample) { return ++calls, mean(resample); });
  // And once for the sample, and for each value left out.
  EXPECT_EQ(calls, 10'000 + 1 + 4);
}

TEST(Bootstrap, OfANormalMeanComesNearStudentsInterval) {
  Stream stream(14, Purpose::test);
  Sample sample(200);
  for (double& x : sample) x = 10.0 + stream.normal();
  const auto boot = *bootstrap(sample, mean);
  const auto student = *mean_interval(*moments(sample));
  EXPECT_NEAR(boot.interval.lower, student.lower, 0.02);
  EXPECT_NEAR(boot.interval.upper, student.upper, 0.02);
  EXPECT_NEAR(boot.standard_error, moments(sample)->sd / std::sqrt(200.0), 0.002);
}

TEST(Bootstrap, OfEqualValuesIsDegenerate) {
  const Sample equal(20, 0.1), other(10, 0.3);
  for (const auto& [name, statistic] : by_name) {
    const auto result = *bootstrap(equal, statistic);
    EXPECT_TRUE(result.degenerate) << name;
    EXPECT_EQ(result.interval.lower, 0.1);
    EXPECT_EQ(result.interval.upper, 0.1);
    EXPECT_EQ(result.standard_error, 0.0);
  }
  const auto difference = *bootstrap_difference(equal, other, mean);
  EXPECT_TRUE(difference.degenerate);
  EXPECT_EQ(difference.interval.lower, 0.1 - 0.3);
}

TEST(Bootstrap, SaysNothingWithTooFewValuesOrOverZero) {
  const Sample none, one{1.0}, two{1.0, 2.0}, with_zeros{0.0, 0.0, 5.0};
  EXPECT_FALSE(bootstrap(none, mean));
  EXPECT_FALSE(bootstrap(one, mean));
  EXPECT_TRUE(bootstrap(two, mean));
  EXPECT_FALSE(bootstrap_difference(two, one, mean));
  EXPECT_FALSE(bootstrap_ratio(two, with_zeros, mean));
  EXPECT_FALSE(bootstrap_paired_ratio(Sample{1.0, 2.0, 3.0}, with_zeros));
  EXPECT_FALSE(bootstrap_paired_ratio(none, none));
}

TEST(Bootstrap, KeepsFiniteWhereAllResamplesLieOnOneSide) {
  // The maximum of a resample never exceeds that of the sample.
  // it.
  const Sample sample{1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
  const auto maximum = *bootstrap(sample, [](std::span<const double> x) { return std::ranges::max(x); });
  EXPECT_EQ(maximum.interval.upper, 6.0);
  int calls = 0;
  const auto above = *bootstrap(sample, [&](std::span<const double> x) {
    return calls++ == 0 ? 100.0 : mean(x);  // the estimate is computed first
  });
  EXPECT_TRUE(std::isfinite(above.bias_correction));
  EXPECT_TRUE(std::isfinite(above.interval.lower));
  EXPECT_LE(above.interval.lower, above.interval.upper);
}

TEST(BootstrapPicks, CoverWhatTheOthersDo) {
  Stream stream(15, Purpose::test);
  Sample a = random_sample(stream, 12), b = random_sample(stream, 9);
  std::ranges::sort(a);
  std::ranges::sort(b);
  const auto picked_mean = [](const Sample& values, const Picks& picks) {
    Sample picked;
    for (const auto i : picks) picked.push_back(values[i]);
    return mean(picked);
  };
  const std::size_t sizes[] = {a.size(), b.size()};
  const auto general = *bootstrap_picks(sizes, [&](std::span<const Picks> picks) {
    return picked_mean(a, picks[0]) - picked_mean(b, picks[1]);
  });
  EXPECT_TRUE(same_bits(general, *bootstrap_difference(a, b, mean)));
}

TEST(BootstrapPicks, DrawEveryElementEquallyOften) {
  std::vector<double> times(7);
  const std::size_t sizes[] = {times.size()};
  bootstrap_picks(sizes, [&](std::span<const Picks> picks) {
    EXPECT_TRUE(std::ranges::is_sorted(picks[0]));
    for (const auto i : picks[0]) times[i] += 1.0;
    return 0.0;
  });
  // 70,000 draws; 5 standard deviations. The jackknife and the sample itself add 7.
  for (const double count : times) EXPECT_NEAR(count, 10'000.0 + 7.0, 465.0);
}

}  // namespace
}  // namespace amble::statistics
