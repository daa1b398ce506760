#include <gtest/gtest.h>

#include "amble/core/random.hpp"
#include "amble/statistics/survival.hpp"
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

}  // namespace
}  // namespace amble::statistics
