#include "amble/controllers/sensing.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "amble/controllers/network.hpp"
#include "amble/core/error.hpp"
#include "amble/io/file.hpp"
#include "amble/io/json_file.hpp"
#include "tests/controllers/one_joint.hpp"
#include "tests/controllers/quadruped.hpp"

namespace amble::controllers {
namespace {

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
      "roll, pitch, yaw, yaw_rate, command_speed, command_turn, command_stop, heading_error or sine");
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

TEST(Sensing, EachRowOfTheTableIsInTheDocs) {
  const std::string docs = io::read_file(AMBLE_SOURCE_DIR "/docs/CONTROLLERS.md");
  for (const substrate::SensorKind& kind : substrate::sensor_kinds())
    EXPECT_NE(docs.find("| `" + std::string(kind.name)), std::string::npos) << kind.name;
}

}  // namespace
}  // namespace amble::controllers
