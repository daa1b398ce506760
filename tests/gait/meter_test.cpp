#include "amble/gait/meter.hpp"
#include "amble/gait/report_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "amble/core/error.hpp"
#include "amble/core/random.hpp"
#include "tests/gait/synthetic_gait.hpp"
#include "tests/motion/fixture.hpp"

namespace amble::gait {
namespace {

using tests::Clockwork;
using tests::Feeder;
using tests::named;
using tests::walk;

TEST(GaitMeter, MeasuresClockworkFeetExactly) {
  // 0.48 s of each 0.8 s on the ground. From 2 s on the left hind foot lands at 2.4, 3.2, …, 19.2 s: 21
  // strides.
  const Report report = walk({25, 75, 0, 50});
  EXPECT_EQ(report.reference_leg, 2);
  ASSERT_EQ(report.legs.size(), 4u);
  const double phases[] = {0.25, 0.75, 0.0, 0.5};
  for (std::size_t leg = 0; leg < 4; ++leg) {
    const LegGait& gait = report.legs[leg];
    EXPECT_NEAR(gait.stride_s.value(), 0.8, 1e-12);
    EXPECT_NEAR(gait.stride_sd_s.value(), 0.0, 1e-9);
    EXPECT_NEAR(gait.duty_factor.value(), 0.6, 1e-12);
    EXPECT_NEAR(gait.phase.value().resultant, 1.0, 1e-12);
    EXPECT_NEAR(std::remainder(gait.phase->phase - phases[leg], 1.0), 0.0, 1e-12);
    EXPECT_NEAR(gait.drift_strides.value(), 0.0, 1e-12);
  }
  EXPECT_EQ(report.legs[2].touchdowns, 22);
  EXPECT_EQ(report.legs[2].strides, 21);
  EXPECT_NEAR(report.duty_factor.value(), 0.6, 1e-12);
  EXPECT_NEAR(report.stride_s.value(), 0.8, 1e-12);
  // Windows 2 … 7, 7 … 12 and, with the rest, 12 … 20 s.
  ASSERT_EQ(report.windows.size(), 3u);
  EXPECT_DOUBLE_EQ(report.windows[0].start_s, 2.0);
  EXPECT_DOUBLE_EQ(report.windows[2].end_s, 20.0);
  EXPECT_DOUBLE_EQ(report.gait_seconds[static_cast<std::size_t>(Gait::walk_lateral)], 18.0);
}

TEST(GaitMeter, FindsTheSamePhasesForUnevenStridesWithTheirSpread) {
  // Left fore lands by turns 0.2 and 0.3 of a stride after left hind: mean 0.25, R = cos(2π × 0.05).
  Feeder feeder;
  for (int k = 0; k < 4000; ++k) {
    // Two strides of 1 s; a foot is on the ground for half a second after each of its two touch-downs.
    const auto stance = [&](int first, int second) {
      return (k % 200 - first + 200) % 200 < 50 || (k % 200 - second + 200) % 200 < 50 ? 1.0f : 0.0f;
    };
    const float hind_left = stance(0, 100), hind_right = stance(50, 150), fore_left = stance(20, 130),
                fore_right = stance(75, 175);
    feeder.add({fore_left, fore_right, hind_left, hind_right});
  }
  const Report report = feeder.finish();
  EXPECT_NEAR(report.quadruped->left.phase, 0.25, 1e-12);
  EXPECT_NEAR(report.quadruped->left.resultant, std::cos(2.0 * std::acos(-1.0) * 0.05), 1e-3);
  EXPECT_EQ(report.classification, named(Gait::walk_lateral));
}

TEST(GaitMeter, TellsTheStandardDeviationOfStridesInSeconds) {
  // Strides of 0.7 to 1.3 s in no order, so over several windows; feet that land together.
  Stream stream(1, Purpose::test, 0);
  std::vector<int> landings;
  for (int frame = 30; frame < 6000; frame += 70 + static_cast<int>(stream.below(61)))
    landings.push_back(frame);
  Feeder feeder;
  for (int k = 0; k < 6000; ++k) {
    const auto next = std::ranges::upper_bound(landings, k);
    const bool touches = next != landings.begin() && k - *std::prev(next) < 40;
    feeder.add(std::vector<float>(4, touches ? 1.0f : 0.0f));
  }
  const Report report = feeder.finish();

  std::vector<double> strides_s;
  for (std::size_t i = 1; i < landings.size(); ++i)
    if (landings[i - 1] >= 200) strides_s.push_back(tests::frame_s * (landings[i] - landings[i - 1]));
  const auto n = static_cast<double>(strides_s.size());
  double mean_s = 0.0, variance_s2 = 0.0;
  for (const double stride_s : strides_s) mean_s += stride_s / n;
  for (const double stride_s : strides_s) variance_s2 += (stride_s - mean_s) * (stride_s - mean_s) / n;
  ASSERT_GT(report.windows.size(), 2u);
  ASSERT_GT(variance_s2, 0.01);
  for (const LegGait& leg : report.legs) {
    EXPECT_EQ(leg.strides, static_cast<std::int64_t>(strides_s.size()));
    EXPECT_NEAR(leg.stride_s.value(), mean_s, 1e-9);
    EXPECT_NEAR(leg.stride_sd_s.value(), std::sqrt(variance_s2), 1e-9);
  }
}

TEST(GaitMeter, SeesThroughContactChatter) {
  // In each stance the sensor drops out for up to three frames, and in each swing it fires once.
  const Clockwork feet{.stride = 80, .stance = 48, .offset = {20, 60, 0, 40}};
  Stream stream(7, Purpose::test);
  Feeder feeder;
  std::vector<int> dropped(4), fired(4);
  for (int k = 0; k < 2000; ++k) {
    auto touch = feet.touch(k);
    for (std::size_t leg = 0; leg < 4; ++leg) {
      const int in_stride = ((k - feet.offset[leg]) % 80 + 80) % 80;
      if (in_stride == 0) dropped[leg] = static_cast<int>(stream.uniform(1.0, 40.0));
      if (in_stride == 48) fired[leg] = static_cast<int>(stream.uniform(58.0, 70.0));
      if (in_stride >= dropped[leg] && in_stride < dropped[leg] + 3) touch[leg] = 0.0f;
      if (in_stride > 5 && in_stride < 40 && in_stride % 9 == 0) touch[leg] = 0.0f;
      if (in_stride == fired[leg] && in_stride > 48) touch[leg] = 1.0f;
    }
    feeder.add(touch);
  }
  const Report report = feeder.finish();
  EXPECT_EQ(report.classification, named(Gait::walk_lateral));
  for (const LegGait& leg : report.legs) {
    EXPECT_GT(leg.raw_touchdowns, 4 * leg.touchdowns);
    EXPECT_NEAR(leg.stride_s.value(), 0.8, 0.001);
    EXPECT_NEAR(leg.duty_factor.value(), 0.6, 0.001);
    EXPECT_GT(leg.phase.value().resultant, 0.999);
  }
}

TEST(GaitMeter, WithoutDebouncingChatterIsStrides) {
  const Clockwork feet{.stride = 80, .stance = 48, .offset = {20, 60, 0, 40}};
  Feeder feeder(4, {.debounce_s = 0.0});
  for (int k = 0; k < 2000; ++k) {
    auto touch = feet.touch(k);
    if (k % 9 == 0) touch[0] = 0.0f;
    feeder.add(touch);
  }
  EXPECT_EQ(feeder.finish().classification, (Classification{Gait::irregular, Irregular::uneven_counts}));
}

TEST(GaitMeter, SaysWhichFootNeverLandsOrNeverLifts) {
  const Clockwork feet{.stride = 80, .stance = 48, .offset = {20, 60, 0, 40}};
  Feeder feeder;
  for (int k = 0; k < 2000; ++k) {
    auto touch = feet.touch(k);
    touch[2] = 0.0f;
    touch[1] = 1.0f;
    feeder.add(touch);
  }
  const Report report = feeder.finish();
  EXPECT_EQ(report.classification, (Classification{Gait::irregular, Irregular::few_strides}));
  EXPECT_EQ(report.reference_leg, 3) << "the right hind foot replaces the left one";
  EXPECT_EQ(report.legs[2].touchdowns, 0);
  EXPECT_EQ(report.legs[2].contact_share, 0.0);
  EXPECT_EQ(report.legs[1].contact_share, 1.0);
  for (const std::size_t leg : {1u, 2u}) {
    EXPECT_FALSE(report.legs[leg].stride_s);
    EXPECT_FALSE(report.legs[leg].duty_factor);
    EXPECT_FALSE(report.legs[leg].phase);
    EXPECT_FALSE(report.legs[leg].drift_strides);
  }
  // Left fore lands 0.75 of a stride after the right hind foot.
  EXPECT_NEAR(report.legs[0].phase.value().phase, 0.75, 1e-12);
  const std::string table = report_table(report);
  EXPECT_NE(table.find("never lands"), std::string::npos) << table;
  EXPECT_NE(table.find("never lifts"), std::string::npos) << table;
  EXPECT_NE(table.find("pairs: hind –, fore –; fore after hind, left –, "), std::string::npos) << table;
  EXPECT_NE(report_json(report).find("\"hind\": {\"phase\": null, \"resultant\": null,"), std::string::npos);
}

TEST(GaitMeter, AFootWhoseTouchesAreTooShortToCountIsSaidToTouch) {
  const Clockwork feet{.stride = 80, .stance = 48, .offset = {20, 60, 0, 40}};
  Feeder feeder;
  for (int k = 0; k < 2000; ++k) {
    auto touch = feet.touch(k);
    touch[2] = k % 20 == 0 ? 1.0f : 0.0f;
    touch[1] = k % 20 == 0 ? 0.0f : 1.0f;
    feeder.add(touch);
  }
  const std::string table = report_table(feeder.finish());
  EXPECT_NE(table.find("touches for less than --debounce"), std::string::npos) << table;
  EXPECT_NE(table.find("lifts for less than --debounce"), std::string::npos) << table;
  EXPECT_EQ(table.find("never"), std::string::npos) << table;
}

TEST(GaitMeter, AFootThatLandsInTheTransientAloneIsNotSaidToTouchTooBriefly) {
  Feeder lands_early, ends_early;
  for (int k = 0; k < 1000; ++k)
    lands_early.add(
        {k % 60 < 30 && k < 180 ? 1.0f : 0.0f, k % 60 < 30 || k >= 180 ? 1.0f : 0.0f, 1.0f, 1.0f});
  std::string table = report_table(lands_early.finish());
  EXPECT_NE(table.find("never lands"), std::string::npos) << table;
  EXPECT_NE(table.find("never lifts"), std::string::npos) << table;
  EXPECT_EQ(table.find("--debounce"), std::string::npos) << table;
  for (int k = 0; k < 150; ++k) ends_early.add({1.0f, 1.0f, 1.0f, k % 60 < 30 ? 1.0f : 0.0f});
  const Report none = ends_early.finish();
  table = report_table(none);
  EXPECT_NE(table.find("all of it is --transient"), std::string::npos) << table;
  EXPECT_EQ(table.find("never"), std::string::npos) << table;
  EXPECT_FALSE(none.legs[0].contact_share) << "nothing was looked at";
  EXPECT_NE(report_json(none).find("\"contact_share\": null"), std::string::npos);
}

TEST(GaitMeter, AFootThatLiftsAtTheEndIsNotSaidToNeverLift) {
  Feeder feeder;
  for (int k = 0; k < 1000; ++k) feeder.add({k < 900 ? 1.0f : 0.0f, k < 400 ? 1.0f : 0.0f, 1.0f, 1.0f});
  const std::string table = report_table(feeder.finish());
  const std::string lifts = "lifts, and does not land again";
  const std::size_t first = table.find(lifts);
  ASSERT_NE(first, std::string::npos) << table;
  EXPECT_NE(table.find(lifts, first + 1), std::string::npos) << table;
  EXPECT_EQ(table.find("--debounce"), std::string::npos) << table;
  EXPECT_EQ(table.find("never lands"), std::string::npos) << table;
}

TEST(GaitMeter, MeasuresHowAPhaseDrifts) {
  // The left fore foot takes strides of 1.01 s beside others of 1 s: it falls behind by 0.01 of a stride
  // in 1.01 s, 0.594 per minute. The first window lasts until the left hind foot ends its fourth stride in
  // frame 700; window means lie from 4.505 s (2 … 7.01) to 54.51 s: 0.495 of a stride.
  Feeder feeder;
  const Clockwork feet{.stride = 100, .stance = 60, .offset = {0, 75, 0, 50}},
      slow{.stride = 101, .stance = 60, .offset = {25}};
  for (int k = 0; k < 5701; ++k) {
    auto touch = feet.touch(k);
    touch[0] = slow.touch(k)[0];
    feeder.add(touch);
  }
  const Report report = feeder.finish();
  EXPECT_NEAR(report.legs[0].drift_per_min.value(), 0.594, 0.005);
  EXPECT_NEAR(report.legs[0].drift_strides.value(), 0.495, 0.01);
  EXPECT_NEAR(report.legs[1].drift_per_min.value(), 0.0, 1e-12);
}

TEST(GaitMeter, TakesTheDutyFactorOfTwoLegsFromBoth) {
  // The right foot is on the ground for twice as long as the left one.
  const Clockwork left{.stride = 80, .stance = 20, .offset = {0}},
      right{.stride = 80, .stance = 40, .offset = {40}};
  Feeder feeder(2);
  for (int k = 0; k < 2000; ++k) feeder.add({left.touch(k)[0], right.touch(k)[0]});
  const Report report = feeder.finish();
  EXPECT_NEAR(report.legs[0].duty_factor.value(), 0.25, 1e-12);
  EXPECT_NEAR(report.legs[1].duty_factor.value(), 0.5, 1e-12);
  EXPECT_NEAR(report.biped->duty_factor, 0.375, 1e-12);
}

TEST(GaitMeter, OfATrialThatEndsAtOnceSaysThatThereWasNothing) {
  for (const int frames : {0, 1, 5, 150}) {
    Feeder feeder;
    feeder.walk({.stride = 80, .stance = 48, .offset = {20, 60, 0, 40}}, frames);
    const Report report = feeder.finish();
    EXPECT_EQ(report.classification, (Classification{Gait::irregular, Irregular::few_strides})) << frames;
    EXPECT_DOUBLE_EQ(report.seconds, 0.01 * frames);
    EXPECT_EQ(report.reference_leg, -1);
    EXPECT_TRUE(report.windows.empty());
    EXPECT_FALSE(report.cost_of_transport_positive);
    EXPECT_FALSE(report_table(report).empty());
    EXPECT_FALSE(report_json(report).empty());
  }
}

TEST(GaitMeter, KeepsAFixedNumberOfWindowsHoweverLongItLasts) {
  // From 2 s to 1000 s there are 198 windows of 5 s and one that takes the rest; merged by two they are 100.
  Feeder feeder;
  feeder.walk({.stride = 80, .stance = 48, .offset = {20, 60, 0, 40}}, 100'000);
  const Report report = feeder.finish();
  EXPECT_EQ(report.windows.size(), 100u);
  EXPECT_DOUBLE_EQ(report.windows.back().end_s, 1000.0);
  for (std::size_t i = 1; i < report.windows.size(); ++i)
    EXPECT_DOUBLE_EQ(report.windows[i].start_s, report.windows[i - 1].end_s);
  EXPECT_EQ(report.classification, named(Gait::walk_lateral));
  EXPECT_DOUBLE_EQ(report.gait_seconds[0], 998.0);
  // The left hind foot lands at 2.4, 3.2, …, 999.2 s.
  EXPECT_EQ(report.legs[2].strides, 1246);
}

TEST(GaitMeter, ComputesSpeedFroudeNumberAndCostOfTransport) {
  // 10 s at 0.5 m/s. Froude: 0.5² / (10 × 0.8) = 0.03125. One joint of 1 N m turns by 0.01 rad a step: 0.01 J
  // a step, 10 J in all but half of the first step's. Cost: 10 / (5 × 10 × 5) = 0.04.
  Body body = tests::synthetic_body();
  body.joints = {"FL.knee"};
  Meter meter(body, 0.01, {});
  const std::vector<float> touch(4, 1.0f), torque{1.0f};
  for (int k = 1; k <= 1000; ++k) {
    const std::vector<float> angle{static_cast<float>(0.01 * k)};
    meter.add({.com_m = {0.005 * k, 0.0, 0.6}, .touch = touch, .angle_rad = angle, .torque_nm = torque});
  }
  const Report report = meter.finish(record::Outcome::completed);
  EXPECT_NEAR(report.speed_m_s, 0.5, 1e-12);
  EXPECT_NEAR(report.path_m, 5.0, 1e-12);
  EXPECT_NEAR(report.straightness.value(), 1.0, 1e-12);
  EXPECT_NEAR(report.froude.value(), 0.03125, 1e-12);
  EXPECT_NEAR(report.work->positive_j, 9.995, 1e-5);
  EXPECT_NEAR(report.cost_of_transport_positive.value(), 9.995 / 250.0, 1e-7);
  EXPECT_NEAR(report.cost_of_transport_absolute.value(), 9.995 / 250.0, 1e-7);
  EXPECT_NEAR(report.windows[0].speed_m_s, 0.5, 1e-9);
}

TEST(GaitMeter, MeasuresACircleAlongItsPath) {
  // Once round a circle of 2 m in 20 s, in chords of a second: 20 × 2 × 2 m × sin(9°).
  Meter meter(tests::synthetic_body(), 0.01, {});
  const std::vector<float> touch(4, 1.0f);
  const double pi = std::acos(-1.0);
  for (int k = 1; k <= 2000; ++k) {
    const double angle = 2.0 * pi * k / 2000.0;
    meter.add({.com_m = {2.0 * std::sin(angle), 2.0 - 2.0 * std::cos(angle), 0.6},
               .touch = touch,
               .angle_rad = {},
               .torque_nm = {}});
  }
  const Report report = meter.finish(record::Outcome::completed);
  EXPECT_NEAR(report.path_m, 80.0 * std::sin(pi / 20.0), 1e-9);
  EXPECT_NEAR(report.straightness.value(), 0.0, 1e-9);
  EXPECT_NEAR(report.path_speed_m_s, report.path_m / 20.0, 1e-12);
}

TEST(GaitMeter, RefusesSettingsOutOfRange) {
  const auto error = [](Settings settings) {
    return tests::error_of([&] { Meter(tests::synthetic_body(), 0.01, settings); });
  };
  EXPECT_EQ(error({.debounce_s = 1.5}), "gait: debounce = 1.5 s: expected 0 to 1 s");
  EXPECT_EQ(error({.window_s = 0.0}), "gait: window = 0 s: expected 0.1 to 3600 s");
  EXPECT_EQ(error({.transient_s = -1.0}), "gait: transient = -1 s: expected 0 to 1e6 s");
}

TEST(GaitMeter, CountsTheRisingEdgesOfEachSensorInTheWholeTrial) {
  for (std::uint32_t i = 0; i < 50; ++i) {
    Stream stream(1, Purpose::test, i);
    Feeder feeder;
    std::vector<std::int64_t> edges(4, 0);
    std::vector<float> before;
    for (std::uint32_t k = 1 + stream.below(600); k-- > 0;) {
      std::vector<float> touch(4);
      for (float& one : touch) one = stream.chance(0.5) ? 1.0f : 0.0f;
      for (std::size_t leg = 0; leg < 4 && !before.empty(); ++leg)
        edges[leg] += touch[leg] > before[leg] ? 1 : 0;
      feeder.add(before = touch);
    }
    const Report report = feeder.finish();
    for (std::size_t leg = 0; leg < 4; ++leg) EXPECT_EQ(report.legs[leg].raw_touchdowns, edges[leg]) << i;
  }
}

TEST(GaitMeter, TakesTheLateralPhaseOfBothSides) {
  // Fore feet land by these shares after the hind feet of their sides: Hildebrand's phase is their mean.
  for (int left = 0; left < 100; left += 10)
    for (int right = left - 40; right <= left + 40; right += 20) {
      const Report report = walk({left, 50 + right, 0, 50});
      const double lateral = 0.005 * (left + right);
      ASSERT_TRUE(report.quadruped.has_value());
      EXPECT_NEAR(std::remainder(report.quadruped->left.phase - 0.01 * left, 1.0), 0.0, 1e-9);
      EXPECT_NEAR(std::remainder(report.quadruped->right.phase - 0.01 * right, 1.0), 0.0, 1e-9);
      // Sides that land once more often than the other weigh a little more.
      EXPECT_NEAR(std::remainder(report.quadruped->lateral - lateral, 1.0), 0.0, 0.01)
          << left << " " << right;
    }
}

TEST(GaitMeter, TakesSettingsUpToTheEndsOfTheirRanges) {
  const auto accepted = [](double Settings::*member, double value) {
    Settings settings;
    settings.*member = value;
    return tests::error_of([&] { settings.validate(); }) == "no error";
  };
  struct Range {
    double Settings::*member;
    double least, most;
  };
  for (const auto& [member, least, most] :
       {Range{&Settings::debounce_s, 0.0, 1.0},
        {&Settings::transient_s, 0.0, 1e6},
        {&Settings::window_s, 0.1, 3600.0},
        {&Settings::longest_stride_s, std::nextafter(0.0, 1.0), 3600.0}}) {
    EXPECT_TRUE(accepted(member, least) && accepted(member, most));
    EXPECT_FALSE(accepted(member, std::nextafter(least, -1.0))) << least;
    EXPECT_FALSE(accepted(member, std::nextafter(most, HUGE_VAL))) << most;
    EXPECT_FALSE(accepted(member, std::nan("")));
  }
  Settings settings;
  settings.longest_stride_s = 0.0;
  EXPECT_EQ(tests::error_of([&] { settings.validate(); }),
            "gait: longest stride = 0 s: expected more than 0, at most 3600 s");
}

}  // namespace
}  // namespace amble::gait
