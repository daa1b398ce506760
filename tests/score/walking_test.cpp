#include "amble/score/walking.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace amble::score {
namespace {

constexpr double frame_s = 0.01;

/// Walking time of a path over `seconds`.
double walking_s(double seconds, const std::function<Vec3(double)>& path, StandingRule rule = {}) {
  WalkingMeter meter(path(0.0), frame_s, rule);
  const auto frames = std::lround(seconds / frame_s);
  for (long i = 1; i <= frames; ++i) meter.add(path(static_cast<double>(i) * frame_s));
  return meter.walking_s();
}

TEST(Walking, LastsTheWholeTrialAtASteadySpeed) {
  EXPECT_DOUBLE_EQ(walking_s(300.0, [](double t) { return Vec3{0.1 * t, 0.0, 0.5}; }), 300.0);
}

TEST(Walking, EndsWhereTheRobotStoppedForAWindow) {
  // At 0.1 m/s it comes 4 m and then stands: the last place from which it went farther than 0.25 m is at 37.5
  // s.
  const auto path = [](double t) { return Vec3{0.1 * std::min(t, 40.0), 0.0, 0.5}; };
  EXPECT_NEAR(walking_s(100.0, path), 37.5, 0.15);
}

TEST(Walking, IsZeroForARobotThatStandsFromTheBeginning) {
  EXPECT_EQ(walking_s(60.0, [](double t) { return Vec3{0.1 * std::sin(t), 0.0, 0.5}; }), 0.0);
}

TEST(Walking, CountsACircleWiderThanTheRadius) {
  const auto circle = [](double radius_m) {
    return [radius_m](double t) { return Vec3{radius_m * std::cos(t), radius_m * std::sin(t), 0.5}; };
  };
  EXPECT_DOUBLE_EQ(walking_s(60.0, circle(0.2)), 60.0);
  EXPECT_EQ(walking_s(60.0, circle(0.1)), 0.0);
}

TEST(Walking, IgnoresHeight) {
  EXPECT_EQ(walking_s(60.0, [](double t) { return Vec3{0.0, 0.0, t}; }), 0.0);
}

TEST(Walking, IsNotCutByAPauseShorterThanTheWindow) {
  const auto path = [](double t) { return Vec3{0.3 * (t < 20.0 ? t : t < 28.0 ? 20.0 : t - 8.0), 0.0, 0.5}; };
  EXPECT_DOUBLE_EQ(walking_s(60.0, path), 60.0);
}

/// Walking time over 20 s of a robot that rushes along x but for one rest, from step `begin` to step `end`.
double walking_with_rest_s(double step_s, long begin, long end) {
  WalkingMeter meter({100.0, 0.0, 0.5}, step_s, {.window_s = 3.0});
  for (long i = 1; i <= std::lround(20.0 / step_s); ++i)
    meter.add({5.0 * static_cast<double>(i < begin ? i - begin : std::max(0L, i - end)), 0.0, 0.5});
  return meter.walking_s();
}

TEST(Walking, EndsInARestAsLongAsTheWindowWhateverTheRoundingOfTimes) {
  // Rests from one sample to another, 30 samples later: as numbers such times differ by a little more or less
  // than 3 s.
  for (const double step_s : {0.1, 0.02, 0.01, 0.001}) {
    const long sample = std::lround(0.1 / step_s);
    for (long k = 1; k <= 150; ++k) {
      ASSERT_NEAR(walking_with_rest_s(step_s, k * sample, (k + 30) * sample), 0.1 * static_cast<double>(k),
                  1e-9)
          << step_s;
      ASSERT_NEAR(walking_with_rest_s(step_s, k * sample, (k + 29) * sample), 20.0, 1e-9)
          << step_s << ", one sample less, from " << k;
    }
  }
}

TEST(Walking, OfATrialShorterThanTheWindowIsAllOfIt) {
  EXPECT_DOUBLE_EQ(walking_s(5.0, [](double) { return Vec3{}; }), 5.0);
}

}  // namespace
}  // namespace amble::score
