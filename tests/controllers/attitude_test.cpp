#include "amble/controllers/attitude.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "amble/core/math.hpp"
#include "amble/core/random.hpp"

namespace amble::controllers {
namespace {

using Kind = substrate::Sensor::Kind;
using substrate::Attitude;

/// Uniform over all rotations, by rejection.
Quat random_rotation(Stream& stream) {
  for (;;) {
    const Quat q{stream.uniform(-1.0, 1.0), stream.uniform(-1.0, 1.0), stream.uniform(-1.0, 1.0),
                 stream.uniform(-1.0, 1.0)};
    const double square = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    if (square > 1.0 || square < 0.01) continue;
    const double scale = 1.0 / std::sqrt(square);
    return {scale * q.w, scale * q.x, scale * q.y, scale * q.z};
  }
}

/// The formula for four numbers in the order x, y, z, w.
RollPitchYaw by_quotients(const double (&q)[4]) {
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  return {std::atan(2.0 * (w * x + y * z) / (w * w - x * x - y * y + z * z)),
          std::asin(2.0 * (w * y - x * z)),
          std::atan(2.0 * (x * y + w * z) / (w * w + x * x - y * y - z * z))};
}

struct Sensed {
  double roll_rad, pitch_rad, yaw_rad;
};

Sensed sensed(Attitude formula, const RollPitchYaw& is) {
  LaneArray attitude_rad(3, 1);
  attitude_rad.at(0, 0) = static_cast<float>(is.roll_rad);
  attitude_rad.at(1, 0) = static_cast<float>(is.pitch_rad);
  attitude_rad.at(2, 0) = static_cast<float>(is.yaw_rad);
  const auto of = [&](Kind kind) {
    float value = 7.0f;
    sense_attitude(kind, formula, attitude_rad, {&value, 1});
    return static_cast<double>(value);
  };
  return {of(Kind::roll), of(Kind::pitch), of(Kind::yaw)};
}

/// At a right angle the arc tangent jumps by π, on a rounding.
void expect_same_arc_tangent(double a, double b) {
  constexpr double right_angle = std::numbers::pi / 2;
  if (std::fabs(a) < right_angle - 1e-5)
    EXPECT_NEAR(a, b, 1e-6);
  else
    EXPECT_NEAR(std::fabs(a), std::fabs(b), 1e-4);
  EXPECT_LT(std::fabs(a), right_angle + 1e-6);
}

TEST(Attitude, MisorderedIsTheAuthorsFormulaOnOdesQuaternionOfARobotThatLooksTheOtherWay) {
  Stream stream(7, Purpose::test);
  const Quat about{0.0, 0.0, 0.0, 1.0};  // half a turn about z
  for (int n = 0; n < 20000; ++n) {
    const Quat ours = random_rotation(stream);
    const Sensed got = sensed(Attitude::misordered_quaternion, roll_pitch_yaw(ours));
    const Quat theirs = about * ours * conjugate(about);
    const auto expected = by_quotients({theirs.w, theirs.x, theirs.y, theirs.z});
    expect_same_arc_tangent(got.roll_rad, expected.roll_rad);
    expect_same_arc_tangent(got.yaw_rad, expected.yaw_rad);
    // Near ± π/2 the arc sine makes much of the last bits of its argument.
    EXPECT_NEAR(std::sin(got.pitch_rad), std::sin(expected.pitch_rad), 1e-6);
  }
}

TEST(Attitude, MisorderedSaysNegativeYawForRollAndNegativeRollForYaw) {
  const Sensed got = sensed(Attitude::misordered_quaternion, {0.25, -0.5, 1.0});
  EXPECT_EQ(got.roll_rad, -1.0);
  EXPECT_EQ(got.pitch_rad, -0.5);
  EXPECT_EQ(got.yaw_rad, -0.25);
}

TEST(Attitude, MisorderedWrapsAtRightAngles) {
  EXPECT_NEAR(sensed(Attitude::misordered_quaternion, {0.0, 0.0, 1.5}).roll_rad, -1.5, 1e-6);
  EXPECT_NEAR(sensed(Attitude::misordered_quaternion, {0.0, 0.0, 1.6}).roll_rad, std::numbers::pi - 1.6,
              1e-6);
  EXPECT_NEAR(sensed(Attitude::misordered_quaternion, {-3.0, 0.0, 0.0}).yaw_rad, 3.0 - std::numbers::pi,
              1e-6);
}

TEST(Attitude, TrueAnglesAreThoseOfTheFrame) {
  Stream stream(8, Purpose::test);
  for (int n = 0; n < 1000; ++n) {
    const auto is = roll_pitch_yaw(random_rotation(stream));
    const Sensed got = sensed(Attitude::true_angles, is);
    EXPECT_EQ(got.roll_rad, static_cast<double>(static_cast<float>(is.roll_rad)));
    EXPECT_EQ(got.pitch_rad, static_cast<double>(static_cast<float>(is.pitch_rad)));
    EXPECT_EQ(got.yaw_rad, static_cast<double>(static_cast<float>(is.yaw_rad)));
  }
}

TEST(AttitudeDeathTest, OtherSensorsHaveNone) {
  const LaneArray attitude_rad(3, 1);
  float value = 0.0f;
  EXPECT_DEATH(sense_attitude(Kind::sine, Attitude::true_angles, attitude_rad, {&value, 1}), "no sensor");
}

}  // namespace
}  // namespace amble::controllers
