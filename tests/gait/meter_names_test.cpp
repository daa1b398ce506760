#include "amble/gait/meter.hpp"
#include "amble/gait/report_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/gait/synthetic_gait.hpp"

namespace amble::gait {
namespace {

using tests::Clockwork;
using tests::Feeder;
using tests::named;
using tests::walk;

TEST(GaitMeter, NamesSyntheticGaitsOfEveryClass) {
  // Lateral sequence: left hind, left fore, right hind, right fore.
  EXPECT_EQ(walk({25, 75, 0, 50}).classification, named(Gait::walk_lateral));
  EXPECT_EQ(walk({75, 25, 0, 50}).classification, named(Gait::walk_diagonal));
  EXPECT_EQ(walk({50, 0, 0, 50}).classification, named(Gait::trot));
  EXPECT_EQ(walk({0, 50, 0, 50}).classification, named(Gait::pace));
  EXPECT_EQ(walk({50, 50, 0, 0}).classification, named(Gait::bound));
  EXPECT_EQ(walk({0, 0, 0, 0}).classification, named(Gait::pronk));
  EXPECT_EQ(walk({60, 80, 0, 20}, 30).classification, named(Gait::gallop));
  EXPECT_EQ(walk({0, 0, 0, 50}).classification, (Classification{Gait::irregular, Irregular::mixed_pairs}));
}

TEST(GaitMeter, NamesGaitsFromOneFrameBesideABorderToTheOther) {
  // A stride of 1.6 s is 160 frames; a sixteenth of it, the tolerance about pace and trot, is 10 frames.
  const auto at = [](int lateral) {
    Feeder feeder;
    feeder.walk({.stride = 160, .stance = 100, .offset = {lateral, lateral + 80, 0, 80}}, 3000);
    return feeder.finish().classification;
  };
  EXPECT_EQ(at(9), named(Gait::pace));
  EXPECT_EQ(at(11), named(Gait::walk_lateral));
  EXPECT_EQ(at(69), named(Gait::walk_lateral));
  EXPECT_EQ(at(71), named(Gait::trot));
  EXPECT_EQ(at(89), named(Gait::trot));
  EXPECT_EQ(at(91), named(Gait::walk_diagonal));
  EXPECT_EQ(at(149), named(Gait::walk_diagonal));
  EXPECT_EQ(at(151), named(Gait::pace));
}

TEST(GaitMeter, NamesBothHalvesOfATrialInWhichTheGaitChanges) {
  Feeder feeder;
  feeder.walk({.stride = 80, .stance = 48, .offset = {40, 0, 0, 40}}, 3200);  // trot
  feeder.walk({.stride = 80, .stance = 48, .offset = {0, 40, 0, 40}}, 3000);  // pace
  const Report report = feeder.finish();
  // Half of the phases lie at 0.5, half at 0.
  EXPECT_EQ(report.classification, (Classification{Gait::irregular, Irregular::spread_phases}));
  // The window of the change holds six strides of the right hind foot, in five of which the right fore foot
  // lands at 0 and in one, cut short, at 0.5: R = 4/6 < 0.7.
  const auto segments = segments_of(report);
  ASSERT_EQ(segments.size(), 3u);
  EXPECT_EQ(segments[0].classification, named(Gait::trot));
  EXPECT_DOUBLE_EQ(segments[0].start_s, 2.0);
  EXPECT_DOUBLE_EQ(segments[0].end_s, 32.0);
  EXPECT_EQ(segments[1].classification, (Classification{Gait::irregular, Irregular::spread_phases}));
  EXPECT_DOUBLE_EQ(segments[1].end_s, 37.0);
  EXPECT_EQ(segments[2].classification, named(Gait::pace));
  EXPECT_DOUBLE_EQ(segments[2].end_s, 62.0);
  EXPECT_DOUBLE_EQ(report.gait_seconds[static_cast<std::size_t>(Gait::trot)], 30.0);
  EXPECT_DOUBLE_EQ(report.gait_seconds[static_cast<std::size_t>(Gait::pace)], 25.0);
  const std::string table = report_table(report);
  EXPECT_NE(table.find("      2.0 … 32.0 s  trot\n"), std::string::npos) << table;
  EXPECT_NE(table.find("\nwindows   trot 30 s pace 25 s irregular 5 s\n"), std::string::npos) << table;
}

TEST(GaitMeter, WaitsForTheStridesOfASlowGait) {
  for (const int stride : {130, 160, 240, 400}) {
    Feeder feeder;
    feeder.walk({.stride = stride, .stance = stride * 6 / 10, .offset = {stride / 2, 0, 0, stride / 2}},
                12'000);
    const Report report = feeder.finish();
    const auto segments = segments_of(report);
    ASSERT_EQ(segments.size(), 1u) << stride << "\n" << report_table(report);
    EXPECT_EQ(segments[0].classification, named(Gait::trot));
    EXPECT_DOUBLE_EQ(segments[0].start_s, 2.0);
    EXPECT_DOUBLE_EQ(segments[0].end_s, 120.0);
    for (const Window& window : report.windows)
      EXPECT_LT(window.end_s - window.start_s, 2.0 * std::max(5.0, 0.05 * stride)) << stride;
  }
}

TEST(GaitMeter, SeesASlowGaitChange) {
  Feeder feeder;
  feeder.walk({.stride = 160, .stance = 96, .offset = {80, 0, 0, 80}}, 6000);  // trot
  feeder.walk({.stride = 160, .stance = 96, .offset = {0, 80, 0, 80}}, 6000);  // pace
  const Report report = feeder.finish();
  const auto segments = segments_of(report);
  ASSERT_GE(segments.size(), 2u);
  ASSERT_LE(segments.size(), 3u) << "with at most one window in which both are";
  EXPECT_EQ(segments.front().classification, named(Gait::trot));
  EXPECT_NEAR(segments.front().end_s, 60.0, 8.0);
  EXPECT_EQ(segments.back().classification, named(Gait::pace));
  EXPECT_NEAR(segments.back().start_s, 60.0, 8.0);
}

TEST(GaitMeter, WaitsForNoFootAtRest) {
  // Trot in which the left hind foot stops landing at 30 s. It can still end a stride for 5 s after its last
  // touch-down; from then on windows are of 5 s again.
  const Clockwork feet{.stride = 80, .stance = 48, .offset = {40, 0, 0, 40}};
  Feeder feeder;
  for (int k = 0; k < 6000; ++k) {
    auto touch = feet.touch(k);
    if (k >= 3000) touch[2] = 0.0f;
    feeder.add(touch);
  }
  const Report report = feeder.finish();
  const auto segments = segments_of(report);
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_EQ(segments[0].classification, named(Gait::trot));
  EXPECT_EQ(segments[1].classification, (Classification{Gait::irregular, Irregular::few_strides}));
  EXPECT_NEAR(segments[1].start_s, 30.0, 5.0);
  for (std::size_t i = 0; i + 1 < report.windows.size(); ++i) {
    const Window& window = report.windows[i];
    EXPECT_LE(window.end_s - window.start_s, window.end_s < 30.0 || window.start_s > 35.0 ? 5.001 : 10.001);
  }
}

TEST(GaitMeter, WaitsNoLongerThanFiveWindows) {
  // The left fore foot lands every 4.5 s beside others that land every 0.8 s: in 10 s two or three times.
  const Clockwork feet{.stride = 80, .stance = 48, .offset = {40, 0, 0, 40}},
      limping{.stride = 450, .stance = 200, .offset = {0}};
  Feeder feeder(4, {.window_s = 2.0});
  for (int k = 0; k < 10'000; ++k) {
    auto touch = feet.touch(k);
    touch[0] = limping.touch(k)[0];
    feeder.add(touch);
  }
  const Report report = feeder.finish();
  ASSERT_EQ(report.windows.size(), 9u);
  for (std::size_t i = 1; i + 1 < report.windows.size(); ++i)
    EXPECT_NEAR(report.windows[i].end_s - report.windows[i].start_s, 10.0, 1e-9);
  // The last one takes what is left over and may be long enough for the fourth stride.
  for (std::size_t i = 0; i + 1 < report.windows.size(); ++i)
    EXPECT_EQ(report.windows[i].classification, (Classification{Gait::irregular, Irregular::few_strides}));
}

TEST(GaitMeter, SaysWhenItIsBetweenWalkingAndRunning) {
  // A stride of 2 s is 200 frames.
  const auto table = [](int stance) {
    Feeder feeder;
    feeder.walk({.stride = 200, .stance = stance, .offset = {100, 0, 0, 100}}, 4000);
    return report_table(feeder.finish());
  };
  EXPECT_NE(table(98).find("trot; running (duty factor 0.49), stride 2.00 s\n"), std::string::npos);
  EXPECT_NE(table(99).find("trot; between walking and running (duty factor 0.495), stride"),
            std::string::npos);
  EXPECT_NE(table(100).find("trot; between walking and running (duty factor 0.500), stride"),
            std::string::npos);
  EXPECT_NE(table(101).find("trot; between walking and running (duty factor 0.505), stride"),
            std::string::npos);
  EXPECT_NE(table(102).find("trot; walking (duty factor 0.51), stride"), std::string::npos);
}

TEST(GaitMeter, GivesPhasesButNoNameToAnEightLeggedRobot) {
  Feeder feeder(8);
  feeder.walk({.stride = 80, .stance = 44, .offset = {0, 40, 40, 0, 0, 40, 40, 0}}, 2000);
  const Report report = feeder.finish();
  EXPECT_FALSE(report.classification);
  EXPECT_FALSE(report.quadruped);
  EXPECT_FALSE(report.hexapod);
  EXPECT_TRUE(report.gait_seconds.empty());
  EXPECT_TRUE(segments_of(report).empty());
  EXPECT_EQ(report.reference_leg, 0);
  EXPECT_NEAR(report.legs[1].phase.value().phase, 0.5, 1e-12);
  EXPECT_NEAR(std::remainder(report.legs[3].phase.value().phase, 1.0), 0.0, 1e-12);
  EXPECT_NEAR(report.duty_factor.value(), 0.55, 1e-12);
  for (const std::string& text : {report_table(report), report_summary(report)}) {
    EXPECT_EQ(text.find("no name"), std::string::npos) << text;
    EXPECT_NE(text.find("  walking (duty factor 0.55), stride 0.80 s\n"), std::string::npos) << text;
  }
}

/// 30 s of six feet in strides of 0.9 s: left ones that land `lag` frames after the one behind, and right
/// ones `across` frames after the left ones beside them.
Report six_legs(int lag, int across, int stance = 60) {
  const auto left = [&](int ahead) { return ahead * lag; };
  Clockwork feet{.stride = 90, .stance = stance, .offset = {}};
  for (const int ahead : {2, 1, 0})
    for (const int side : {0, across}) feet.offset.push_back(left(ahead) + side);
  Feeder feeder(6);
  feeder.walk(feet, 3000);
  return feeder.finish();
}

TEST(GaitMeter, NamesTheGaitsOfSixLegs) {
  EXPECT_EQ(six_legs(45, 45, 50).classification, named(Gait::tripod));
  EXPECT_EQ(six_legs(30, 45).classification, named(Gait::tetrapod));
  EXPECT_EQ(six_legs(30, 30).classification, named(Gait::tetrapod)) << "two legs swing together";
  EXPECT_EQ(six_legs(30, 60).classification, named(Gait::tetrapod)) << "its mirror image";
  EXPECT_EQ(six_legs(15, 45, 75).classification, named(Gait::wave));
  const auto irregular = [](Irregular reason) { return Classification{Gait::irregular, reason}; };
  EXPECT_EQ(six_legs(60, 45).classification, irregular(Irregular::no_wave)) << "from front to back";
  EXPECT_EQ(six_legs(0, 45).classification, irregular(Irregular::no_wave)) << "side by side";
  EXPECT_EQ(six_legs(0, 0).classification, irregular(Irregular::no_alternation)) << "all together";
  EXPECT_EQ(six_legs(45, 30).classification, irregular(Irregular::no_alternation));
}

TEST(GaitMeter, TellsPairsAndLagsOfSixLegs) {
  const Report report = six_legs(30, 45);
  EXPECT_EQ(report.reference_leg, 4) << "the left hind foot";
  ASSERT_TRUE(report.hexapod);
  for (const PairPhase& pair : report.hexapod->pairs) EXPECT_NEAR(pair.phase, 0.5, 1e-12);
  for (const PairPhase& lag : report.hexapod->lags) EXPECT_NEAR(lag.phase, 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(report.hexapod->lag, 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(report.duty_factor.value(), 2.0 / 3.0, 1e-12);
  const std::string table = report_table(report), json = report_json(report);
  EXPECT_NE(table.find("gait       tetrapod; walking (duty factor 0.67)"), std::string::npos) << table;
  EXPECT_NE(table.find("pairs: fore 0.50 (R 1.00), middle 0.50 (R 1.00)"), std::string::npos) << table;
  EXPECT_NE(json.find("\"gait\": \"tetrapod\""), std::string::npos);
  EXPECT_NE(json.find("\"left_middle\""), std::string::npos);
  EXPECT_NE(json.find("\"tripod\": 0"), std::string::npos);
  EXPECT_EQ(json.find("\"trot\""), std::string::npos) << "is of four legs";
}

TEST(GaitMeter, NamesTheGaitsOfTwoLegs) {
  const auto two_legs = [](int right, int stance) {
    Feeder feeder(2);
    feeder.walk({.stride = 80, .stance = stance, .offset = {0, right}}, 2000);
    return feeder.finish();
  };
  EXPECT_EQ(two_legs(40, 48).classification, named(Gait::walk));
  EXPECT_EQ(two_legs(40, 40).classification, named(Gait::walk)) << "no time in the air";
  EXPECT_EQ(two_legs(40, 28).classification, named(Gait::run));
  EXPECT_EQ(two_legs(0, 48).classification, named(Gait::hop));
  EXPECT_EQ(two_legs(0, 28).classification, named(Gait::hop));
  EXPECT_EQ(two_legs(20, 28).classification, (Classification{Gait::irregular, Irregular::no_alternation}));
  const Report run = two_legs(44, 28);
  EXPECT_EQ(run.classification, named(Gait::run));
  EXPECT_NEAR(run.biped->pair.phase, 0.55, 1e-12);
  EXPECT_NEAR(run.biped->duty_factor, 0.35, 1e-12);
  EXPECT_NE(report_table(run).find("gait       run; running (duty factor 0.35)"), std::string::npos);
  EXPECT_NE(report_table(run).find("pair: right after left 0.55 (R 1.00)\n"), std::string::npos);
  EXPECT_DOUBLE_EQ(run.gait_seconds[static_cast<std::size_t>(Gait::run)], 18.0);
}

}  // namespace
}  // namespace amble::gait
