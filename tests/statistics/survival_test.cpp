#include "amble/statistics/survival.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "amble/core/random.hpp"
#include "tests/statistics/lifetimes.hpp"

namespace amble::statistics {
namespace {

using tests::agrees;
using tests::is_near;
using tests::Json;
using tests::oracles;

void expect_band(const std::optional<Interval>& band, const Json& lower, const Json& upper) {
  ASSERT_EQ(band.has_value(), !lower.is_null());
  if (!band) return;
  EXPECT_TRUE(is_near(*band, lower, upper));
}

void expect_median(const SurvivalCurve& curve, const Json& expected) {
  EXPECT_TRUE(agrees(curve.median_s, expected[0]));
  EXPECT_TRUE(agrees(curve.median_lower_s, expected[1]));
  EXPECT_TRUE(agrees(curve.median_upper_s, expected[2]));
}

void expect_curve(const std::vector<Lifetime>& lifetimes, const Json& expected) {
  const auto curve = kaplan_meier(lifetimes);
  const auto log_log = kaplan_meier(lifetimes, 0.95, SurvivalBand::log_log);
  ASSERT_TRUE(curve && log_log);
  ASSERT_EQ(curve->steps.size(), expected["time_s"].size());
  for (std::size_t i = 0; i < curve->steps.size(); ++i) {
    const auto& step = curve->steps[i];
    EXPECT_EQ(step.time_s, expected["time_s"][i].get<double>());
    EXPECT_EQ(step.at_risk, expected["at_risk"][i].get<double>());
    EXPECT_EQ(step.ended, expected["ended"][i].get<double>());
    EXPECT_TRUE(is_near(step.survival, expected["survival"][i], 1e-15));
    EXPECT_TRUE(agrees(step.variance ? std::optional(std::sqrt(*step.variance)) : std::nullopt,
                       expected["standard_error"][i]));
    expect_band(step.band, expected["log_lower"][i], expected["log_upper"][i]);
    expect_band(log_log->steps[i].band, expected["log_log_lower"][i], expected["log_log_upper"][i]);
  }
  expect_median(*curve, expected["log_median"]);
  expect_median(*log_log, expected["log_log_median"]);
}

TEST(KaplanMeier, IsThatOfR) {
  ASSERT_GE(oracles()["lifetimes"].size(), 20u);
  for (const auto& set : oracles()["lifetimes"]) {
    const auto groups = tests::lifetimes_of(set["groups"]);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      SCOPED_TRACE(set["name"].dump() + " group " + std::to_string(g));
      const auto& expected = set["curves"][g];
      if (expected.is_null()) {
        EXPECT_FALSE(kaplan_meier(groups[g]));
      } else {
        expect_curve(groups[g], expected);
      }
    }
  }
}

TEST(KaplanMeier, WithoutCensoringIsTheShareThatLasts) {
  Stream stream(8, Purpose::test);
  for (int i = 0; i < 300; ++i) {
    std::vector<Lifetime> lifetimes(1 + stream.below(40));
    for (auto& life : lifetimes) life.time_s = static_cast<double>(stream.below(20));
    const auto curve = *kaplan_meier(lifetimes);
    const auto n = static_cast<double>(lifetimes.size());
    for (double time_s = -0.5; time_s < 21.0; time_s += 0.5) {
      const auto lasting = std::ranges::count_if(lifetimes, [&](auto& l) { return l.time_s > time_s; });
      const double share = static_cast<double>(lasting) / n;
      EXPECT_NEAR(curve.at(time_s), share, 1e-14);
    }
    // Greenwood's variance is then the binomial one.
    for (const auto& step : curve.steps) {
      if (!step.variance) continue;
      EXPECT_NEAR(*step.variance, step.survival * (1.0 - step.survival) / n, 1e-14);
    }
  }
}

TEST(KaplanMeier, FallsAndLiesInItsBand) {
  Stream stream(9, Purpose::test);
  for (int i = 0; i < 500; ++i) {
    std::vector<Lifetime> lifetimes(1 + stream.below(40));
    for (auto& life : lifetimes) life = {static_cast<double>(stream.below(30)), stream.chance(0.6)};
    for (const auto band : {SurvivalBand::log, SurvivalBand::log_log}) {
      double before = 1.0;
      const auto curve = *kaplan_meier(lifetimes, 0.9, band);
      for (const auto& step : curve.steps) {
        EXPECT_LE(step.survival, before);
        before = step.survival;
        const bool on_scale = step.survival < 1.0 || band == SurvivalBand::log;
        ASSERT_EQ(step.band.has_value(), step.survival > 0.0 && on_scale);
        if (!step.band) continue;
        EXPECT_TRUE(step.band->contains(step.survival));
        EXPECT_GE(step.band->lower, 0.0);
        EXPECT_LE(step.band->upper, 1.0);
      }
    }
  }
}

TEST(KaplanMeier, SaysNothingWithoutLifetimesAndHasNoMedianIfMostLast) {
  EXPECT_FALSE(kaplan_meier({}));
  const std::vector<Lifetime> lasting{{300.0, false}, {300.0, false}, {20.0, true}};
  const auto curve = *kaplan_meier(lasting);
  EXPECT_FALSE(curve.median_s);
  EXPECT_EQ(curve.ended, 1u);
  EXPECT_EQ(curve.at(19.0), 1.0);
  EXPECT_NEAR(curve.at(1e6), 2.0 / 3.0, 1e-15);
}

using tests::is_near;
using tests::oracles;

using Groups = std::vector<std::vector<Lifetime>>;

Groups random_groups(Stream& stream, std::size_t k, double chance_of_end) {
  Groups groups(k);
  for (auto& group : groups) {
    group.resize(3 + stream.below(20));
    for (auto& life : group) life = {static_cast<double>(stream.below(40)), stream.chance(chance_of_end)};
  }
  return groups;
}

TEST(LogRank, IsThatOfR) {
  int compared = 0;
  for (const auto& set : oracles()["lifetimes"]) {
    SCOPED_TRACE(set["name"]);
    const auto& expected = set["log_rank"];
    if (expected.is_null()) continue;
    ++compared;
    const auto groups = tests::lifetimes_of(set["groups"]);
    const auto test = log_rank(groups);
    ASSERT_TRUE(test);
    EXPECT_TRUE(is_near(test->chi_square, expected["chi_square"][0]));
    EXPECT_EQ(test->degrees_of_freedom, expected["degrees_of_freedom"][0].get<double>());
    EXPECT_TRUE(is_near(test->p, expected["p"][0]));
    // R drops groups that are empty.
    std::size_t row = 0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (groups[g].empty()) continue;
      EXPECT_EQ(test->observed[g], expected["observed"][row].get<double>());
      EXPECT_TRUE(is_near(test->expected[g], expected["expected"][row++]));
    }
  }
  EXPECT_GE(compared, 20);
}

TEST(LogRank, SaysNothingIfNothingEndsOrOneGroupIsLeft) {
  EXPECT_FALSE(log_rank({}));
  EXPECT_FALSE(log_rank(Groups{{{1.0, true}}}));
  EXPECT_FALSE(log_rank(Groups{{{1.0, true}}, {}}));
  EXPECT_FALSE(log_rank(Groups{{{300.0, false}}, {{300.0, false}}}));
  // The first group is gone before anything ends.
  EXPECT_FALSE(log_rank(Groups{{{0.5, false}}, {{1.0, true}, {2.0, true}}}));
}

TEST(LogRank, FindsNothingIfAllEndAtOnce) {
  const auto test = log_rank(Groups{{{4.0, true}, {4.0, true}}, {{4.0, true}}, {{4.0, true}}});
  ASSERT_TRUE(test);
  EXPECT_EQ(test->chi_square, 0.0);
  EXPECT_EQ(test->p, 1.0);
  EXPECT_EQ(test->degrees_of_freedom, 2u);
}

TEST(LogRank, OfFewIsJudgedByAllWaysToDealThemOut) {
  // Three against three, as far apart as can be: two of twenty ways.
  const Groups apart{{{1.0, true}, {2.0, true}, {3.0, true}}, {{7.0, true}, {8.0, true}, {9.0, false}}};
  const auto test = log_rank(apart);
  ASSERT_TRUE(test && test->exact_p);
  EXPECT_LT(test->p, 0.05);
  EXPECT_DOUBLE_EQ(*test->exact_p, 0.1);
  EXPECT_EQ(log_rank(Groups{{{4.0, true}}, {{4.0, true}}})->exact_p, 1.0);
  const Groups large(2, std::vector<Lifetime>(10, {4.0, true}));
  EXPECT_FALSE(log_rank(large)->exact_p) << "there are 184,756 ways";
}

TEST(LogRank, OfTrueHypothesesIsByAllWaysNeverRejectedTooOften) {
  Stream stream(12, Purpose::test);
  int rejected = 0;
  constexpr int tests = 2000;
  for (int i = 0; i < tests; ++i) {
    Groups groups(2, std::vector<Lifetime>(4));
    for (auto& group : groups)
      for (auto& life : group) life = {stream.uniform(), stream.chance(0.7)};
    const auto test = log_rank(groups);
    if (test && *test->exact_p < 0.05) ++rejected;
  }
  // 4.6 standard errors of a share of 0.05 in 2000.
  EXPECT_LT(rejected / static_cast<double>(tests), 0.05 + 0.023);
  EXPECT_GT(rejected, 0);
}

TEST(LogRank, DependsNeitherOnTheOrderOfGroupsNorOnTheScaleOfTime) {
  Stream stream(10, Purpose::test);
  for (int i = 0; i < 300; ++i) {
    auto groups = random_groups(stream, 2 + stream.below(5), 0.7);
    const auto test = log_rank(groups);
    if (!test) continue;
    const double observed = std::accumulate(test->observed.begin(), test->observed.end(), 0.0);
    EXPECT_NEAR(std::accumulate(test->expected.begin(), test->expected.end(), 0.0), observed, 1e-10);
    std::rotate(groups.begin(), groups.begin() + 1, groups.end());
    for (auto& group : groups) {
      std::ranges::reverse(group);
      for (auto& life : group) life.time_s *= life.time_s;
    }
    EXPECT_NEAR(log_rank(groups)->chi_square, test->chi_square, 1e-9 * (1.0 + test->chi_square));
  }
}

TEST(LogRank, RejectsTrueHypothesesAboutAsOftenAsItSays) {
  Stream stream(11, Purpose::test);
  int rejected = 0;
  constexpr int tests = 4000;
  for (int i = 0; i < tests; ++i) {
    Groups groups(3, std::vector<Lifetime>(20));
    for (auto& group : groups) {
      for (auto& life : group) {
        const double time_s = -std::log(1.0 - stream.uniform()) * 100.0;
        life = {std::min(time_s, 150.0), time_s < 150.0};
      }
    }
    if (log_rank(groups)->p < 0.05) ++rejected;
  }
  // 4.6 standard errors of a share of 0.05 in 4000.
  EXPECT_NEAR(rejected / static_cast<double>(tests), 0.05, 0.016);
}

}  // namespace

}  // namespace amble::statistics
