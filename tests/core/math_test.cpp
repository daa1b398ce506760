#include "amble/core/math.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "amble/core/random.hpp"

namespace amble {
namespace {

constexpr double pi = std::numbers::pi;

TEST(Quat, TurnsByTheRightHandRule) {
  const Vec3 v = rotate(axis_angle({0, 0, 1}, pi / 2), {1, 0, 0});
  EXPECT_NEAR(v.x, 0.0, 1e-15);
  EXPECT_NEAR(v.y, 1.0, 1e-15);
  EXPECT_NEAR(v.z, 0.0, 1e-15);
}

TEST(Quat, ProductRotatesByTheRightFactorFirst) {
  const Quat a = axis_angle({0, 0, 1}, 0.3), b = axis_angle({1, 0, 0}, 1.1);
  const Vec3 v{0.2, -1.0, 3.0};
  const Vec3 together = rotate(a * b, v), in_turn = rotate(a, rotate(b, v));
  EXPECT_NEAR(norm(together - in_turn), 0.0, 1e-14);
  EXPECT_NEAR(norm(rotate(conjugate(a) * a, v) - v), 0.0, 1e-14);
}

TEST(RollPitchYaw, RecoversRandomAngles) {
  Stream stream(1, Purpose::test);
  for (int i = 0; i < 1000; ++i) {
    const double roll = stream.uniform(-pi, pi), pitch = stream.uniform(-1.5, 1.5),
                 yaw = stream.uniform(-pi, pi);
    const auto angles = roll_pitch_yaw(axis_angle({0, 0, 1}, yaw) * axis_angle({0, 1, 0}, pitch) *
                                       axis_angle({1, 0, 0}, roll));
    EXPECT_NEAR(angles.roll_rad, roll, 1e-9);
    EXPECT_NEAR(angles.pitch_rad, pitch, 1e-9);
    EXPECT_NEAR(angles.yaw_rad, yaw, 1e-9);
  }
}

}  // namespace
}  // namespace amble
