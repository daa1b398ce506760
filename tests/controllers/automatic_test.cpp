#include "amble/controllers/automatic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "amble/controllers/automatic_legs.hpp"
#include "amble/controllers/factory.hpp"
#include "amble/core/error.hpp"
#include "amble/core/random.hpp"
#include "amble/io/json_file.hpp"
#include "amble/morphology/robot_file.hpp"
#include "tests/controllers/one_joint.hpp"
#include "tests/robot/legged.hpp"

namespace amble::controllers {
namespace {

const std::array<std::pair<const char*, const char*>, 3> kinds{
    {{"supg", "supg"}, {"network", "sine"}, {"ctrnn", "ctrnn"}}};

ControllerSettings automatic(const char* kind) {
  ControllerSettings settings;
  settings.kind = kind;
  settings.substrate.layout = substrate::LayoutSource::automatic;
  return settings;
}

std::vector<std::pair<std::string, robot::RobotSpec>> robots() {
  const auto quadruped = tests::legged_robot(2);
  return {{"quadruped", quadruped},
          {"quadruped without a hip_io", tests::without_hip_io(quadruped, 2)},
          {"quadruped with a held knee", tests::with_held_joint(quadruped, 1, 0)},
          {"hexapod", tests::legged_robot(3)},
          {"biped", tests::legged_robot(1)}};
}

std::vector<double> at(const substrate::Settings& settings, const std::string& node) {
  const auto found = std::ranges::find(settings.nodes, node, &substrate::NodeSettings::name);
  return found == settings.nodes.end() ? std::vector<double>() : found->at;
}

bool has_link(const substrate::Settings& settings, const std::string& from, const std::string& to) {
  return std::ranges::any_of(settings.links,
                             [&](const auto& link) { return link.from == from && link.to == to; });
}

TEST(AutomaticSubstrate, OfThePapersQuadrupedIsTheListInConfigsPartsFieldByField) {
  for (const char* file : {"authors", "paper"}) {
    const auto robot =
        morphology::load_robot(std::string(AMBLE_SOURCE_DIR) + "/robots/quadruped/" + file + ".toml");
    for (const auto& [kind, part] : kinds) {
      ControllerSettings settings = automatic(kind);
      const auto listed = substrate::part(part);
      // As a user does: all but the lists is as in that file.
      settings.substrate.expression_threshold = listed.expression_threshold;
      settings.substrate.weight_range = listed.weight_range;
      settings.substrate.sine_period_s = listed.sine_period_s;
      auto made = substrate_of(settings, robot);
      auto expected = listed;
      EXPECT_EQ(io::settings_to_json(made).dump(1), io::settings_to_json(expected).dump(1)) << kind << file;
    }
  }
}

TEST(AutomaticSubstrate, DrivesEveryDrivenJointOfEveryRobot) {
  for (const auto& [name, robot] : robots()) {
    for (const auto& [kind, part] : kinds) {
      const auto architecture = make_architecture(automatic(kind), robot, 0.01);
      const auto& layout = *architecture->substrate();
      for (std::size_t joint = 0; joint < robot.joints.size(); ++joint)
        EXPECT_EQ(layout.driver(static_cast<int>(joint)) >= 0, robot.joints[joint].driven()) << name << kind;
    }
  }
}

TEST(AutomaticSubstrate, GivesControllersThatDecodeAndCommandFiniteAnglesWithinTheRanges) {
  for (const auto& [name, robot] : robots()) {
    for (const auto& [kind, part] : kinds) {
      const auto architecture = make_architecture(automatic(kind), robot, 0.01);
      const auto parameters =
          architecture->decode(constant_cppn(static_cast<int>(architecture->cppn_inputs().size()),
                                             std::vector<double>(architecture->cppn_outputs().size(), 0.7)));
      const auto batch = architecture->make_batch(1);
      batch->load(0, *parameters);
      const int joints = static_cast<int>(robot.joints.size());
      const robot::SensorFrame sensors{LaneArray(joints, 1),
                                       LaneArray(static_cast<int>(robot.legs.size()), 1), LaneArray(3, 1)};
      LaneArray targets(joints, 1);
      for (int tick = 0; tick < 3; ++tick) batch->step(sensors, targets);
      for (int joint = 0; joint < joints; ++joint) {
        const auto range = robot.joints[to_index(joint)].command_range();
        const double target = targets.at(joint, 0);
        EXPECT_TRUE(target >= range.lower_rad - 1e-6 && target <= range.upper_rad + 1e-6)
            << name << kind << robot.joints[to_index(joint)].name << target;
      }
    }
  }
}

TEST(AutomaticSubstrate, LeavesNodesOutWhereALegHasNoJointAndNoOtherMoves) {
  const auto robot = tests::legged_robot(2);
  const auto lacking = tests::without_hip_io(robot, 2), holding = tests::with_held_joint(robot, 2, 2);
  for (const auto& make : {automatic_supg, automatic_network, automatic_ctrnn}) {
    const auto whole = make(robot), less = make(lacking);
    EXPECT_FALSE(at(whole, "L2.hip_io").empty());
    EXPECT_TRUE(at(less, "L2.hip_io").empty());
    for (const auto& node : less.nodes) EXPECT_EQ(node.at, at(whole, node.name)) << node.name;
    EXPECT_LE(less.nodes.size() + 1, whole.nodes.size());
    EXPECT_EQ(io::settings_to_json(less).dump(), io::settings_to_json(make(holding)).dump());
  }
}

TEST(AutomaticSupg, SpreadsSixLegsEvenlyAndCloseTogether) {
  const auto settings = automatic_supg(tests::legged_robot(3));
  ASSERT_EQ(settings.nodes.size(), 18u);
  const double legs[] = {-0.02, -0.012, -0.004, 0.004, 0.012, 0.02};
  for (std::size_t i = 0; i < 18; ++i)
    EXPECT_EQ(settings.nodes[i].at, (std::vector{legs[i / 3], static_cast<double>(i % 3) - 1.0}));
}

TEST(AutomaticSupg, RoundsPlacesToTwoDecimalsWhereThoseTellAllLegsApart) {
  // The second leg's place before it is divided by 50: -1 + 2/99 of 100 legs, -1 + 2/101 of 102.
  EXPECT_EQ(automatic_supg(tests::legged_robot(50)).nodes[3].at[0], -98.0 / 5000.0);
  EXPECT_EQ(automatic_supg(tests::legged_robot(51)).nodes[3].at[0], (2.0 / 101.0 - 1.0) / 50.0);
}

TEST(AutomaticSupg, HasOneJointTypeAndOneLegAt0) {
  robot::RobotSpec robot = tests::legged_robot(1);
  for (const int type : {1, 2})
    for (const int leg : {0, 1}) robot = tests::with_held_joint(robot, leg, type);
  auto settings = automatic_supg(robot);
  ASSERT_EQ(settings.nodes.size(), 2u);
  EXPECT_EQ(settings.nodes[0].at, (std::vector{-0.02, 0.0}));
  robot.legs.pop_back();
  settings = automatic_supg(robot);
  ASSERT_EQ(settings.nodes.size(), 1u);
  EXPECT_EQ(settings.nodes[0].at, (std::vector{0.0, 0.0}));
}

TEST(AutomaticNetwork, HasRowsWithoutTheMiddleForEvenNumbersOfLegs) {
  const auto six = automatic_network(tests::legged_robot(3));
  const char* const names[] = {"L1", "R1", "L2", "R2", "L3", "R3"};
  const double rows[] = {-1, -0.6667, -0.3333, 0.3333, 0.6667, 1};
  for (std::size_t leg = 0; leg < 6; ++leg)
    EXPECT_EQ(at(six, names[leg] + std::string(".touch")), (std::vector{-1.0, rows[leg], 0.5}));
  EXPECT_EQ(at(six, "sine"), (std::vector{-1.0, 0.3333, 1.0}));
  EXPECT_EQ(six.nodes.size(), 6u * 4 + 4 + 6 * 5 + 18);
  EXPECT_EQ(at(six, "R3.hidden 5"), (std::vector{0.0, 1.0, 1.0}));

  robot::RobotSpec three = tests::legged_robot(2);
  three.legs.pop_back();
  three.joints.resize(9);
  EXPECT_EQ(at(automatic_network(three), "R1.touch")[1], 0.0);
}

TEST(AutomaticNetwork, PutsTheBodysSensorsIntoMoreColumnsWhereThereAreFewerRows) {
  const auto two = automatic_network(tests::legged_robot(1));
  EXPECT_EQ(at(two, "pitch"), (std::vector{-1.0, -1.0, 0.6}));
  EXPECT_EQ(at(two, "roll"), (std::vector{-1.0, 1.0, 0.6}));
  EXPECT_EQ(at(two, "yaw"), (std::vector{-1.0, -1.0, 1.0}));
  EXPECT_EQ(at(two, "sine"), (std::vector{-1.0, 1.0, 1.0}));
  EXPECT_EQ(at(two, "L1.hidden 6"), (std::vector{0.0, -1.0, 1.0}));
}

TEST(AutomaticCtrnn, PlacesModulesAsTheHipsAre) {
  robot::RobotSpec robot = tests::legged_robot(3);
  auto settings = automatic_ctrnn(robot);
  const auto module = [&](const char* touch) {
    const auto place = at(settings, touch);
    return std::vector(place.begin() + 2, place.end());
  };
  EXPECT_EQ(module("L1.touch"), (std::vector{-1.0, 1.0}));
  EXPECT_EQ(module("R2.touch"), (std::vector{1.0, 0.0}));
  EXPECT_EQ(module("L3.touch"), (std::vector{-1.0, -1.0}));
  // The middle hips 0.2 m further in front, of 0.8 m from hindmost to foremost.
  for (const int leg : {2, 3}) robot.bodies[to_index(1 + 2 * leg)].position_m.x += 0.2;
  settings = automatic_ctrnn(robot);
  EXPECT_EQ(module("L2.touch"), (std::vector{-1.0, 0.5}));
  settings = automatic_ctrnn(tests::legged_robot(1));
  EXPECT_EQ(module("L1.touch"), (std::vector{-1.0, 0.0}));
}

TEST(AutomaticCtrnn, LinksEachModuleWithTheOneInFrontAndTheOneBeside) {
  const auto settings = automatic_ctrnn(tests::legged_robot(3));
  for (const auto& [hind, front] : {std::pair("2", "1"), std::pair("3", "2")}) {
    EXPECT_TRUE(
        has_link(settings, std::string("L") + hind + ".knee", std::string("L") + front + ".hidden left"));
    EXPECT_TRUE(has_link(settings, std::string("L") + hind + ".hip_io", std::string("L") + front + ".touch"));
    EXPECT_TRUE(
        has_link(settings, std::string("R") + hind + ".knee", std::string("R") + front + ".hidden right"));
  }
  for (const std::string row : {"1", "2", "3"}) {
    EXPECT_TRUE(has_link(settings, "L" + row + ".hidden right", "R" + row + ".hidden left"));
    EXPECT_TRUE(has_link(settings, "L" + row + ".hip_fb", "R" + row + ".hip_fb"));
  }
  EXPECT_FALSE(has_link(settings, "L3.knee", "L1.hidden left"));
  EXPECT_EQ(settings.links.size(), 7u + 2 * 2 * 3 + 2 * 3);
}

TEST(AutomaticCtrnn, IsAChainWhereLeftAndRightCannotBeTold) {
  robot::RobotSpec robot = tests::legged_robot(2);
  for (std::size_t leg = 0; leg < 4; ++leg) robot.bodies[1 + 2 * leg].position_m.y = 0.0;
  const auto settings = automatic_ctrnn(robot);
  EXPECT_EQ(at(settings, "R1.touch"), (std::vector{0.0, -1.0, 0.0, 0.3333}));
  EXPECT_TRUE(has_link(settings, "R1.knee", "L1.hidden left"));
  EXPECT_TRUE(has_link(settings, "R2.knee", "L2.hidden left"));
  EXPECT_EQ(settings.links.size(), 7u + 3 * 3);
  EXPECT_EQ(make_architecture(automatic("ctrnn"), robot, 0.01)->cppn_outputs().size(), 4u);
}

TEST(AutomaticCtrnn, OfOneLegHasNoOutputForLinksBetweenModules) {
  EXPECT_EQ(automatic_ctrnn([] {
              robot::RobotSpec robot = tests::legged_robot(1);
              robot.legs.pop_back();
              return robot;
            }())
                .outputs,
            (std::vector<std::string>{"intra", "bias", "time_constant"}));
}

/// An automatic CTRNN whose modules sense this.
ControllerSettings sensing_modules(std::vector<std::string> sensors) {
  ControllerSettings settings = automatic("ctrnn");
  settings.ctrnn.sensors = std::move(sensors);
  return settings;
}

TEST(AutomaticCtrnn, GivesEachModuleItsSensesWhichActOnTheSidesInOppositeSensesWhereTheyTellThemApart) {
  const auto robot = tests::legged_robot(2);
  const auto settings =
      substrate_of(sensing_modules({"command_speed", "command_turn", "angle.hip_fb"}), robot);
  EXPECT_EQ(at(settings, "L1.command_turn"), (std::vector{0.0, -2.0, -1.0, 1.0}));
  const auto angle = std::ranges::find(settings.nodes, "R2.angle.hip_fb", &substrate::NodeSettings::name);
  ASSERT_NE(angle, settings.nodes.end());
  EXPECT_EQ(angle->sensor, "angle.R2_hip_fb");
  EXPECT_EQ(settings.outputs.size(), automatic_ctrnn(robot).outputs.size() + 2);

  const auto made = make_architecture(sensing_modules({"command_speed", "command_turn"}), robot, 0.01);
  EXPECT_TRUE(made->extra_senses().command);
  const substrate::Layout& layout = *made->substrate();
  std::vector<double> outputs(layout.output_names().size());
  outputs[to_index(std::ranges::find(layout.output_names(), "turn") - layout.output_names().begin())] = 1.0;
  const auto decoded = layout.decode(constant_cppn(static_cast<int>(layout.input_names().size()), outputs));
  int steered = 0;
  for (std::size_t i = 0; i < decoded.weights.size(); ++i) {
    const substrate::Link& link = layout.links()[i];
    const bool turns = layout.nodes()[to_index(link.source)].group == "turn";
    const double side = layout.nodes()[to_index(link.target)].at[2];
    EXPECT_FLOAT_EQ(decoded.weights[i], turns ? static_cast<float>(3.0 * side) : 0.0f);
    steered += turns ? 1 : 0;
  }
  EXPECT_EQ(steered, 4 * 5) << "two hidden neurons and three motors a leg";
}

TEST(AutomaticCtrnn, MotorsHaveBiasesByTheCppnWhereTheyAreToEvolve) {
  ControllerSettings settings = automatic("ctrnn");
  settings.ctrnn.motor_bias = MotorBias::evolved;
  const auto made = make_architecture(settings, tests::legged_robot(2), 0.01);
  const substrate::Layout& layout = *made->substrate();
  std::vector<double> outputs(layout.output_names().size());
  outputs[to_index(std::ranges::find(layout.output_names(), "bias") - layout.output_names().begin())] = 0.5;
  const auto decoded = layout.decode(constant_cppn(static_cast<int>(layout.input_names().size()), outputs));
  for (std::size_t i = 0; i < layout.nodes().size(); ++i)
    if (!layout.nodes()[i].sensor) {
      EXPECT_FLOAT_EQ(decoded.of("bias")[i], layout.nodes()[i].joint >= 0 ? 1.5f : 0.5f);
    }
}

TEST(AutomaticCtrnn, WithoutSensesIsAsItWasAndRefusesThoseThatItCannotGive) {
  const auto robot = tests::legged_robot(2);
  EXPECT_EQ(io::settings_to_json(substrate_of(automatic("ctrnn"), robot)).dump(), [&] {
    substrate::Settings made = automatic_ctrnn(robot);
    made.layout = substrate::LayoutSource::listed;
    return io::settings_to_json(made).dump();
  }());
  EXPECT_FALSE(io::settings_to_json(automatic("ctrnn")).at("ctrnn").contains("sensors"));
  const auto refusal = [&](ControllerSettings settings) -> std::string {
    try {
      substrate_of(settings, robot);
    } catch (const SettingError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_NE(refusal(sensing_modules({"pitch", "pitch"})).find("[1] = \"pitch\" is there twice"),
            std::string::npos);
  EXPECT_NE(refusal(sensing_modules({"touch"})).find("modules sense touch already"), std::string::npos);
  EXPECT_NE(refusal(sensing_modules({"angle.toe"})).find("no joint type toe"), std::string::npos);
  ControllerSettings listed = sensing_modules({"pitch"});
  listed.substrate = automatic_ctrnn(robot);
  EXPECT_NE(refusal(listed).find("the nodes of controller.substrate are listed"), std::string::npos);
}

TEST(AutomaticSubstrate, WhatASettingChangesInItIsRefusedWhereAListedOneIsNotSo) {
  const auto robot = tests::legged_robot(2);
  ControllerSettings ctrnn = automatic("ctrnn"), mixed = automatic("mixed");
  ctrnn.ctrnn.motor_bias = MotorBias::evolved;
  mixed.mixed.neurons = LegNeurons::none;
  for (ControllerSettings* const settings : {&ctrnn, &mixed}) {
    ControllerSettings made = *settings, other = *settings;
    made.substrate = substrate_of(made, robot);
    EXPECT_NO_THROW(substrate_of(made, robot)) << "as champions have it";
    other.substrate = settings == &ctrnn ? automatic_ctrnn(robot) : automatic_mixed(robot);
    other.substrate.layout = substrate::LayoutSource::listed;
    EXPECT_THROW(substrate_of(other, robot), SettingError) << settings->kind;
  }
}

TEST(AutomaticSubstrate, SuitsRobotsOfOneToFiveLegPairsWithAnyJointsHeld) {
  // Whatever is held: the layout is accepted, which refuses equal places, groups without nodes, links that
  // link nothing, and outputs that nothing reads.
  Stream stream(3, Purpose::test);
  int made = 0;
  for (int sample = 0; sample < 100; ++sample) {
    robot::RobotSpec robot = tests::legged_robot(1 + sample % 5);
    const double share = stream.uniform(0.0, 1.0);
    for (robot::Joint& joint : robot.joints)
      if (stream.uniform(0.0, 1.0) < share) joint.command = robot::AngleRange{};
    if (sample % 3 == 0)
      for (robot::Body& body : robot.bodies) body.position_m.y = 0.0;
    if (std::ranges::none_of(robot.joints, &robot::Joint::driven)) continue;
    for (const auto& [kind, part] : kinds) EXPECT_NO_THROW(make_architecture(automatic(kind), robot, 0.01));
    ++made;
  }
  EXPECT_GT(made, 70);
}

TEST(AutomaticSubstrate, RefusesListsBesideIt) {
  for (const auto& [kind, part] : kinds) {
    ControllerSettings settings = automatic(kind);
    settings.substrate = substrate::part(part);
    settings.substrate.layout = substrate::LayoutSource::automatic;
    try {
      substrate_of(settings, tests::legged_robot(2));
      ADD_FAILURE() << "not refused";
    } catch (const SettingError& error) {
      EXPECT_EQ(error.keys(), (std::vector<std::string>{"controller.substrate.coordinates"}));
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
}

TEST(AutomaticSubstrate, IsAKeyThatJsonLeavesOutWhereNodesAreListed) {
  auto settings = automatic("supg");
  EXPECT_EQ(io::settings_to_json(settings)["substrate"]["layout"], "auto");
  settings.substrate.layout = substrate::LayoutSource::listed;
  const auto json = io::settings_to_json(settings);
  EXPECT_FALSE(json["substrate"].contains("layout"));
  const auto again = io::settings_from_json<ControllerSettings>(io::JsonView(json, "x"));
  EXPECT_EQ(again.substrate.layout, substrate::LayoutSource::listed);
}

}  // namespace
}  // namespace amble::controllers
