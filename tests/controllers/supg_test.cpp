#include "amble/controllers/supg.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "amble/core/error.hpp"
#include "tests/controllers/supg_substrate.hpp"

namespace amble::controllers {
namespace supg_test {

constexpr double timestep_s = 0.01;

using neat::Activation;
using neat::NodeKind;

/// A CPPN of linear functions: pattern = p · (bias, leg, type, time), offset = o · (bias, leg, type, time).
cppn::Network linear_cppn(std::array<double, 4> p, std::array<double, 4> o) {
  neat::Genome genome;
  for (std::uint32_t id = 0; id < 6; ++id)
    genome.nodes.push_back({id,
                            id == 0  ? NodeKind::bias
                            : id < 4 ? NodeKind::input
                                     : NodeKind::output,
                            Activation::linear});
  for (std::uint32_t i = 0; i < 4; ++i) genome.links.push_back({i, i, 4, p[i]});
  for (std::uint32_t i = 0; i < 4; ++i) genome.links.push_back({4 + i, i, 5, o[i]});
  return {genome, {cppn::Linear::identity, true}};
}

const SupgParameters& as_supg(const std::unique_ptr<Parameters>& parameters) {
  return dynamic_cast<const SupgParameters&>(*parameters);
}

TEST(Supg, TakesInputsAndOutputsOfItsCppnFromTheSubstrate) {
  const SupgArchitecture architecture(SupgSettings(), supg_substrate(), quadruped(), timestep_s);
  EXPECT_EQ(architecture.layout().input_names(), (std::vector<std::string>{"leg", "joint_type", "time"}));
  EXPECT_EQ(architecture.layout().output_names(), (std::vector<std::string>{"pattern", "offset"}));
  EXPECT_EQ(architecture.name(), "supg");
}

TEST(Supg, RefusesASubstrateInWhichALegCouldGetTwoOffsets) {
  auto substrate = supg_substrate();
  substrate.properties[1].zero.clear();
  try {
    SupgArchitecture(SupgSettings(), substrate, quadruped(), timestep_s);
    FAIL() << "accepted";
  } catch (const UserError& error) {
    EXPECT_STREQ(error.what(),
                 "controller.substrate.properties: \"FL.knee\" and \"FL.hip_fb\" are SUPGs of leg FL but "
                 "could get different offsets: name in 'zero' the coordinates that tell them apart");
  }
}

TEST(Supg, DecodesAGenomeIntoHandComputedAngles) {
  // pattern = 0.1 + 5 leg + 0.25 type + 0.5 time, with leg −0.02, −0.0066, 0.0066, 0.02 and type −1, 0, 1.
  const SupgArchitecture architecture(SupgSettings(), supg_substrate(), quadruped(), timestep_s);
  const auto parameters = architecture.decode(linear_cppn({0.1, 5.0, 0.25, 0.5}, {}));
  const SupgParameters& supg = as_supg(parameters);
  ASSERT_EQ(supg.period_ticks(), 100);
  for (int tick = 0; tick <= 100; ++tick) {
    const double time = tick / 100.0;
    // FL knee: −0.8 + 0.8 (pattern + 1)/2 with pattern = 0.1 − 0.1 − 0.25 + time/2.
    EXPECT_NEAR(supg.targets_rad(0, tick)[0], -0.8 + 0.4 * (0.75 + 0.5 * time), 1e-6);
    // FR hip_fb: −0.8 + 1.6 (pattern + 1)/2 with pattern = 0.1 − 0.033 + time/2.
    EXPECT_NEAR(supg.targets_rad(1, tick)[1], 0.8 * (0.067 + 0.5 * time), 1e-6);
    // BR hip_io: 0.4 (pattern + 1)/2 with pattern = 0.1 + 0.1 + 0.25 + time/2.
    EXPECT_NEAR(supg.targets_rad(3, tick)[2], 0.2 * (1.45 + 0.5 * time), 1e-6);
    // BL knee: 0.8 (pattern + 1)/2 with pattern = 0.1 + 0.033 − 0.25 + time/2.
    EXPECT_NEAR(supg.targets_rad(2, tick)[0], 0.4 * (0.883 + 0.5 * time), 1e-6);
  }
}

/// The quadruped without its front right leg's middle joint, and with a head that is held.
robot::RobotSpec limping() {
  robot::RobotSpec robot = quadruped();
  robot.joints.erase(robot.joints.begin() + 4);
  robot.legs[1].joints = {3, -1, 4};
  robot.legs[2].joints = {5, 6, 7};
  robot.legs[3].joints = {8, 9, 10};
  robot::Joint& head = robot.joints.emplace_back();
  head.name = "head";
  head.lower_rad = -1.0;
  head.upper_rad = 1.0;
  head.command = robot::AngleRange{0.25, 0.25};
  return robot;
}

TEST(Supg, LeavesOutAJointThatALegLacksAndHoldsThoseOfNoLeg) {
  auto substrate = supg_substrate();
  std::erase_if(substrate.nodes, [](const auto& node) { return node.joint == "FR_hip_fb"; });
  const SupgArchitecture architecture(SupgSettings(), substrate, limping(), timestep_s);
  const SupgArchitecture whole(SupgSettings(), supg_substrate(), quadruped(), timestep_s);
  const auto network = linear_cppn({0.1, 5.0, 0.25, 0.5}, {0.3, 1.0, 0.0, 0.0});
  const auto parameters = architecture.decode(network), all = whole.decode(network);

  const auto batch = architecture.make_batch(2), reference = whole.make_batch(2);
  batch->load(1, *parameters);
  reference->load(1, *all);
  robot::SensorFrame sensors{.joint_angle_rad = {}, .touch = LaneArray(4, 2), .attitude_rad = {}};
  LaneArray targets(12, 2), expected(12, 2);
  targets.set_lane(1, 9.0f);
  for (int tick = 0; tick < 250; ++tick) {
    for (int leg = 0; leg < 4; ++leg) sensors.touch.at(leg, 1) = (tick / (20 + leg)) % 2 == 0 ? 1.0f : 0.0f;
    batch->step(sensors, targets);
    reference->step(sensors, expected);
    for (int row = 0; row < 11; ++row)
      ASSERT_EQ(targets.at(row, 1), expected.at(row < 4 ? row : row + 1, 1)) << tick << " " << row;
    ASSERT_EQ(targets.at(11, 1), 0.25f);
  }
  EXPECT_EQ(nlohmann::json::parse(architecture.parameters_json(*parameters))["patterns_rad"].size(), 11u);
}

TEST(Supg, RefusesANodeThatDrivesAHeldJoint) {
  auto robot = quadruped();
  robot.joints[4].command = robot::AngleRange{0.1, 0.1};
  try {
    SupgArchitecture(SupgSettings(), supg_substrate(), robot, timestep_s);
    FAIL() << "accepted";
  } catch (const UserError& error) {
    EXPECT_STREQ(error.what(),
                 "controller.substrate.nodes[4].joint = \"FR_hip_fb\": the robot's file has that joint held, "
                 "not driven");
  }
}

TEST(Supg, ClampsCommandsToTheStops) {
  const SupgArchitecture architecture(SupgSettings(), supg_substrate(), quadruped(), timestep_s);
  // pattern = −3 + 6 time: at the lower stop until time = 1/3, at the upper from 2/3 on.
  const auto parameters = architecture.decode(linear_cppn({-3.0, 0.0, 0.0, 6.0}, {}));
  const SupgParameters& supg = as_supg(parameters);
  EXPECT_EQ(supg.targets_rad(0, 0)[0], -0.8f);
  EXPECT_EQ(supg.targets_rad(0, 33)[0], -0.8f);
  EXPECT_NEAR(supg.targets_rad(0, 50)[0], -0.4, 1e-6);
  EXPECT_EQ(supg.targets_rad(0, 67)[0], 0.0f);
  EXPECT_EQ(supg.targets_rad(3, 100)[1], 0.8f);
}

TEST(Supg, PutsStoppedJointsToMidRange) {
  const SupgArchitecture architecture(SupgSettings(), supg_substrate(), quadruped(), timestep_s);
  const auto parameters = architecture.decode(linear_cppn({0.7, 0.0, 0.0, 0.0}, {}));
  const float* const front = as_supg(parameters).targets_rad(1, SupgParameters::stopped);
  EXPECT_FLOAT_EQ(front[0], -0.4f);
  EXPECT_FLOAT_EQ(front[1], 0.0f);
  EXPECT_FLOAT_EQ(front[2], 0.2f);
  EXPECT_FLOAT_EQ(as_supg(parameters).targets_rad(2, SupgParameters::stopped)[0], 0.4f);
}

TEST(Supg, DecodesOffsetsFromLegAlone) {
  // a = 0.005 + 10 leg: −0.195, −0.061, 0.071, 0.205; ceil((a + 1) 50) is 41, 47, 54, 61. Type and time count
  // as zero.
  const SupgArchitecture architecture(SupgSettings(), supg_substrate(), quadruped(), timestep_s);
  const auto parameters = architecture.decode(linear_cppn({}, {0.005, 10.0, 7.0, 7.0}));
  for (int leg = 0; leg < 4; ++leg)
    EXPECT_EQ(as_supg(parameters).offset_ticks(leg),
              (std::array{41, 47, 54, 61}[static_cast<std::size_t>(leg)]));
}

TEST(Supg, ClampsOffsetsInsideThePeriod) {
  const SupgArchitecture architecture(SupgSettings(), supg_substrate(), quadruped(), timestep_s);
  EXPECT_EQ(as_supg(architecture.decode(linear_cppn({}, {-1.0, 0, 0, 0}))).offset_ticks(0), 1);
  EXPECT_EQ(as_supg(architecture.decode(linear_cppn({}, {-9.0, 0, 0, 0}))).offset_ticks(0), 1);
  EXPECT_EQ(as_supg(architecture.decode(linear_cppn({}, {-0.97, 0, 0, 0}))).offset_ticks(0), 2);
  EXPECT_EQ(as_supg(architecture.decode(linear_cppn({}, {0.97, 0, 0, 0}))).offset_ticks(0), 99);
  EXPECT_EQ(as_supg(architecture.decode(linear_cppn({}, {1.0, 0, 0, 0}))).offset_ticks(0), 99);
}

TEST(Supg, WritesItsParametersAsJson) {
  SupgSettings settings;
  settings.period_s = 0.04;
  settings.idle = Idle::hold;
  const SupgArchitecture architecture(settings, supg_substrate(), quadruped(), timestep_s);
  const auto parameters = architecture.decode(linear_cppn({0.0, 0.0, 0.0, 1.0}, {0.1, 0.0, 0.0, 0.0}));
  const auto json = nlohmann::json::parse(architecture.parameters_json(*parameters));
  EXPECT_EQ(json["kind"], "supg");
  EXPECT_EQ(json["period_ticks"], 4);
  EXPECT_EQ(json["period_s"], 0.04);
  EXPECT_EQ(json["timestep_s"], 0.01);
  EXPECT_EQ(json["trigger"], "edge");
  EXPECT_EQ(json["offset"], "phase");
  EXPECT_EQ(json["start_tick"], 1);
  EXPECT_EQ(json["idle"], "hold");
  EXPECT_EQ(json["legs"], (nlohmann::json{"FL", "FR", "BL", "BR"}));
  EXPECT_EQ(json["joint_types"], (nlohmann::json{"knee", "hip_fb", "hip_io"}));
  EXPECT_EQ(json["offset_ticks"], (nlohmann::json{3, 3, 3, 3}));
  ASSERT_EQ(json["patterns_rad"].size(), 12u);
  // Joint 1 is FL hip_fb: −0.8 … 0.8, command (time + 1)/2.
  ASSERT_EQ(json["patterns_rad"][1].size(), 5u);
  for (std::size_t tick = 0; tick <= 4; ++tick)
    EXPECT_FLOAT_EQ(json["patterns_rad"][1][tick].get<float>(), 0.2f * static_cast<float>(tick));
}

TEST(SupgDeathTest, RefusesACppnOfAnotherShape) {
  const SupgArchitecture architecture(SupgSettings(), supg_substrate(), quadruped(), timestep_s);
  neat::Genome genome;
  for (std::uint32_t id = 0; id < 5; ++id)
    genome.nodes.push_back({id,
                            id == 0  ? NodeKind::bias
                            : id < 4 ? NodeKind::input
                                     : NodeKind::output,
                            Activation::linear});
  EXPECT_DEATH(architecture.decode({genome, {}}), "another number of outputs");
}

TEST(Supg, RefusesARobotThatItsSubstrateDoesNotFit) {
  robot::RobotSpec robot = quadruped();
  robot.legs.pop_back();
  robot.joints.resize(9);
  EXPECT_THROW(SupgArchitecture(SupgSettings(), supg_substrate(), robot, timestep_s), UserError);
}

}  // namespace supg_test
}  // namespace amble::controllers
