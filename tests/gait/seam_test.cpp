#include "amble/gait/seam.hpp"

#include <gtest/gtest.h>

#include <array>

namespace amble::gait {
namespace {

/// Two legs with two joints each.
robot::RobotSpec two_legs() {
  robot::RobotSpec robot;
  robot.legs.resize(2);
  robot.legs[0].joints = {0, 1};
  robot.legs[1].joints = {2, -1};
  return robot;
}

TEST(SeamMeter, TakesTheFarthestTargetOfALegThatJumps) {
  SeamMeter meter(two_legs(), 0.01);
  const std::array<float, 3> rest{};
  const auto add = [&](std::array<float, 3> target, std::array<float, 2> timer,
                       std::array<float, 2> trigger) {
    meter.add({.target_rad = target, .angle_rad = rest, .torque_nm = {}, .timer = timer, .trigger = trigger});
  };
  add({0.0f, 0.0f, 0.0f}, {-1.0f, 5.0f}, {0.0f, 0.0f});
  add({0.1f, -0.3f, 0.2f}, {0.0f, 6.0f}, {0.0f, 0.0f});  // the first leg starts: 0.3 rad; the second goes on
  add({0.2f, -0.2f, 0.7f}, {1.0f, 1.0f}, {0.0f, 1.0f});  // the second is triggered: 0.5 rad
  add({0.3f, -0.1f, 0.8f}, {2.0f, 1.0f}, {0.0f, 1.0f});  // and again, to where it is: 0.1 rad
  add({0.4f, 0.0f, 0.9f}, {-1.0f, 2.0f}, {0.0f, 0.0f});  // the first stops: 0.1 rad
  add({0.4f, 0.0f, 1.0f}, {-1.0f, 3.0f}, {0.0f, 0.0f});
  const SeamReport report = meter.report();
  EXPECT_EQ(report.jumps, 4);
  EXPECT_NEAR(report.mean_rad, (0.3 + 0.5 + 0.1 + 0.1) / 4, 1e-6);
  EXPECT_NEAR(report.largest_rad, 0.5, 1e-6);
  EXPECT_FALSE(report.power_after_w);
}

TEST(SeamMeter, TakesPowerInTheTenthOfASecondAfterAJumpOnly) {
  SeamMeter meter(two_legs(), 0.01);
  const std::array<float, 3> targets{};
  float angle = 0.0f;
  for (int frame = 0; frame < 60; ++frame) {
    // 2 N m at 1 rad/s in the ten frames from the trigger on, three times as fast else; the other leg is
    // still.
    const bool after = frame >= 20 && frame < 30;
    angle += after ? 0.01f : 0.03f;
    const std::array<float, 3> angles{angle, 0.0f, 0.0f}, torques{-2.0f, 5.0f, 5.0f};
    const std::array<float, 2> timers{static_cast<float>(frame), static_cast<float>(frame)},
        triggers{frame == 20 ? 1.0f : 0.0f, 0.0f};
    meter.add({targets, angles, torques, timers, triggers});
  }
  EXPECT_EQ(meter.report().jumps, 1);
  EXPECT_NEAR(meter.report().power_after_w.value(), 2.0, 1e-3);
}

}  // namespace
}  // namespace amble::gait
