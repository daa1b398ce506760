#include "amble/score/walking.hpp"

#include <gtest/gtest.h>

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

TEST(Walking, OfATrialShorterThanTheWindowIsAllOfIt) {
  EXPECT_DOUBLE_EQ(walking_s(5.0, [](double) { return Vec3{}; }), 5.0);
}

}  // namespace
}  // namespace amble::score
