#include "amble/controllers/sensing.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "amble/controllers/network.hpp"
#include "amble/core/error.hpp"
#include "amble/core/math.hpp"
#include "amble/core/random.hpp"
#include "amble/io/file.hpp"
#include "amble/io/json_file.hpp"
#include "tests/controllers/one_joint.hpp"
#include "tests/controllers/quadruped.hpp"

namespace amble::controllers {
namespace sensing_test {

using Kind = substrate::Sensor::Kind;

std::string refusal(const std::vector<SensorSettings>& sensors) {
  try {
    sensor_models({sensors}, quadruped(), 0.01);
  } catch (const SettingError& error) {
    return error.what();
  }
  return "none";
}

TEST(Sensing, NamesOneSensorOrAllOfAKind) {
  const auto models = sensor_models({{{.of = "angle", .delay_s = 0.03},
                                      {.of = "pitch", .scale = 2.0},
                                      {.of = "touch.BL", .dead_time_s = 0.05}}},
                                    quadruped(), 0.01);
  ASSERT_EQ(models.size(), 14u);
  EXPECT_EQ(models[11].sensor, (substrate::Sensor{Kind::angle, 11}));
  EXPECT_EQ(models[11].delay_ticks, 3);
  EXPECT_EQ(models[13].sensor, (substrate::Sensor{Kind::touch, 2}));
  EXPECT_EQ(models[13].hold_ticks, 5);
  EXPECT_FALSE(models[12].is_imperfect());
  EXPECT_EQ(scale_of(models, {Kind::pitch, 0}), 2.0f);
  EXPECT_EQ(scale_of(models, {Kind::roll, 0}), 1.0f);
}

TEST(Sensing, RefusesWhatCannotBeInOneLine) {
  EXPECT_EQ(
      refusal({{.of = "smell"}}),
      "controller.sensing.sensors[0].of = \"smell\": expected angle.JOINT, touch.LEG, load.LEG, speed.JOINT, "
      "torque.JOINT, "
      "roll, pitch, yaw, yaw_rate, command_speed, command_turn, command_stop, heading_error or sine; for all "
      "of a kind angle, touch, load, speed, torque");
  EXPECT_EQ(refusal({{.of = "angle"}, {.of = "angle.FL_knee"}}),
            "controller.sensing.sensors[1].of = \"angle.FL_knee\": angle.FL_knee is there already");
  EXPECT_EQ(refusal({{.of = "pitch", .delay_s = 0.015}}),
            "controller.sensing.sensors[0].delay_s = 0.015 is 1.5 ticks of 0.01 s: expected a whole number");
  EXPECT_EQ(refusal({{.of = "sine", .noise = 1.0}}),
            "controller.sensing.sensors[0].of = \"sine\" is a clock, not a sensor: expected a scale alone");
}

TEST(Sensing, IsLeftOutOfJsonWhereEverySensorIsReadAtOnceAndExactly) {
  SensingSettings settings{
      {{.of = "yaw_rate", .scale = 0.5, .noise = 0.1, .delay_s = 0.02, .dead_time_s = 0.03}}};
  EXPECT_EQ(io::settings_from_json<SensingSettings>(io::JsonView(io::settings_to_json(settings), "x")),
            settings);
  EXPECT_TRUE(settings.is_noisy());
  EXPECT_FALSE(SensingSettings().is_noisy());
}

/// A sensor that drives the joint of a robot with one, through one neuron.
NetworkArchitecture through_one_neuron(const std::string& sensor, const SensingSettings& sensing = {}) {
  substrate::Settings substrate;
  substrate.coordinates = {"x"};
  substrate.outputs = {"weight"};
  substrate.nodes.resize(2);
  substrate.nodes[0].name = "in";
  substrate.nodes[0].at = {-1.0};
  substrate.nodes[0].sensor = sensor;
  substrate.nodes[1].name = "out";
  substrate.nodes[1].at = {1.0};
  substrate.nodes[1].joint = "L_knee";
  substrate.links.resize(1);
  substrate.links[0].from = "in";
  substrate.links[0].to = "out";
  substrate.links[0].weight = "weight";
  return NetworkArchitecture(NetworkSettings(), substrate, one_joint(), 0.01, sensing);
}

TEST(Sensing, NetworksReadEachKindOfSensorTimesItsScale) {
  Bench angle(through_one_neuron("angle.L_knee"), {0.7});
  angle.sensors().joint_angle_rad.at(0, 0) = 0.5f;
  angle.tick();
  const float expected = angle.target_rad();
  EXPECT_NE(expected, 0.0f);
  const auto scaled = [](const char* of, double scale) {
    return SensingSettings{{{.of = of, .scale = scale}}};
  };
  Bench speed(through_one_neuron("speed.L_knee", scaled("speed", 0.125)), {0.7});
  speed.sensors().joint_speed_rad_s = LaneArray(1, 1);
  speed.sensors().joint_speed_rad_s.at(0, 0) = 4.0f;
  speed.tick();
  EXPECT_EQ(speed.target_rad(), expected);
  Bench torque(through_one_neuron("torque.L_knee", scaled("torque.L_knee", -2.0)), {0.7});
  torque.sensors().joint_torque_nm = LaneArray(1, 1);
  torque.sensors().joint_torque_nm.at(0, 0) = -0.25f;
  torque.tick();
  EXPECT_EQ(torque.target_rad(), expected);
  Bench turning(through_one_neuron("yaw_rate"), {0.7});
  turning.sensors().yaw_rate_rad_s = LaneArray(1, 1);
  turning.sensors().yaw_rate_rad_s.at(0, 0) = 0.5f;
  turning.tick();
  EXPECT_EQ(turning.target_rad(), expected);
}

TEST(Sensing, SaysWhatMustBeSensedBesideWhatEnginesGive) {
  EXPECT_EQ(through_one_neuron("speed.L_knee").extra_senses(), (robot::ExtraSenses{.speed = true}));
  EXPECT_EQ(through_one_neuron("torque.L_knee").extra_senses(), (robot::ExtraSenses{.torque = true}));
  EXPECT_EQ(through_one_neuron("yaw_rate").extra_senses(), (robot::ExtraSenses{.yaw_rate = true}));
  EXPECT_FALSE(through_one_neuron("pitch").extra_senses().any());
}

TEST(Sensing, TheTableInTheDocsHasEachSensorWithItsUnitAndWhatCountsAsOneAndNoOther) {
  const std::string docs = io::read_file(AMBLE_SOURCE_DIR "/docs/CONTROLLERS.md");
  const std::size_t begin = docs.find("\n| sensor | unit | full |"), end = docs.find("\n\n", begin);
  ASSERT_NE(begin, std::string::npos);
  const std::string table = docs.substr(begin, end - begin);
  for (const substrate::SensorKind& kind : substrate::sensor_kinds()) {
    using Owner = substrate::SensorOwner;
    const char* const of = kind.owner == Owner::joint ? ".JOINT" : kind.owner == Owner::leg ? ".LEG" : "";
    std::string row = fmt::format("\n| `{}{}` | {} | ", kind.name, of, kind.unit);
    if (kind.owner == Owner::clock)
      row += "– |";
    else if (kind.full == std::numbers::pi)
      row += "π |";
    else if (kind.full != 0.0)  // else it depends on the robot, in words
      row += fmt::format("{} |", kind.full);
    EXPECT_NE(table.find(row), std::string::npos) << row;
  }
  // One more line each for the head and what is below it.
  EXPECT_EQ(std::ranges::count(table, '\n'), std::ssize(substrate::sensor_kinds()) + 2);
}

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

}  // namespace sensing_test

}  // namespace amble::controllers
