// Each mistake in a substrate is one line that names the key.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "amble/core/error.hpp"
#include "tests/substrate/fixture.hpp"

namespace amble::substrate {
namespace {

/// What is said of a substrate, without the common start of the key.
std::string refusal(const Settings& settings, const Needs& needs) {
  try {
    const Layout layout(settings, needs, controllers::quadruped());
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    const std::string text = error.what(), start = "controller.substrate.";
    EXPECT_TRUE(text.starts_with(start)) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos);
    return text.substr(start.size());
  }
  return "none";
}

std::string ctrnn(const std::function<void(Settings&)>& spoil) {
  auto settings = part("ctrnn");
  spoil(settings);
  return refusal(settings, ctrnn_needs());
}

std::string supg(const std::function<void(Settings&)>& spoil) {
  auto settings = part("supg");
  spoil(settings);
  return refusal(settings, supg_needs());
}

LinkSettings a_link(const std::string& from, const std::string& to, const std::string& output) {
  LinkSettings link;
  link.from = from;
  link.to = to;
  link.weight = output;
  return link;
}

TEST(BadSubstrate, TheGivenOnesAreSound) {
  EXPECT_EQ(ctrnn([](Settings&) {}), "none");
  EXPECT_EQ(supg([](Settings&) {}), "none");
  EXPECT_EQ(refusal(part("sine"), network_needs()), "none");
}

TEST(BadSubstrate, LinkToANodeThatIsNotThere) {
  EXPECT_EQ(ctrnn([](Settings& s) { s.links[7].to = "FL.hidden middle"; }),
            "links[7].to = \"FL.hidden middle\": there is no node and no group of that name");
  EXPECT_EQ(ctrnn([](Settings& s) { s.links[0].from = ""; }),
            "links[0].from = \"\": there is no node and no group of that name");
  EXPECT_EQ(ctrnn([](Settings& s) { s.properties[0].of = "motor"; }),
            "properties[0].of = \"motor\": there is no node and no group of that name");
}

TEST(BadSubstrate, TwoNodesInOnePlaceOrOfOneName) {
  EXPECT_EQ(ctrnn([](Settings& s) { s.nodes[2].at = s.nodes[1].at; }),
            "nodes[2].at: \"FL.hidden right\" has the same coordinates as \"FL.hidden left\" (nodes[1])");
  EXPECT_EQ(ctrnn([](Settings& s) {
              s.nodes[2].at = {-1 + 1e-12, 0, -1, 1};
            }),
            "nodes[2].at: \"FL.hidden right\" has the same coordinates as \"FL.hidden left\" (nodes[1])")
      << "a CPPN cannot tell them apart";
  EXPECT_EQ(ctrnn([](Settings& s) { s.nodes[2].name = "FL.touch"; }),
            "nodes[2].name = \"FL.touch\": nodes[0] is called so, too");
  EXPECT_EQ(ctrnn([](Settings& s) { s.nodes[2].name = ""; }), "nodes[2].name is missing");
  EXPECT_EQ(ctrnn([](Settings& s) { s.nodes[2].group = "FL.touch"; }),
            "nodes[2].group = \"FL.touch\": nodes[0], which is another node, is called so");
}

TEST(BadSubstrate, ButANodeMayBeCalledAsItsOwnGroupOfOne) {
  EXPECT_EQ(ctrnn([](Settings& s) { s.nodes[1].group = s.nodes[1].name; }),
            "properties: \"FL.hidden left\" has no bias, which a controller of kind ctrnn needs");
}

TEST(BadSubstrate, OutputThatTheCppnLacksOrNobodyReads) {
  EXPECT_EQ(ctrnn([](Settings& s) { s.links[3].weight = "inner"; }),
            "links[3].weight = \"inner\": the CPPN has no such output (it has intra, inter, bias, "
            "time_constant)");
  EXPECT_EQ(ctrnn([](Settings& s) { s.properties[0].output = "biases"; }),
            "properties[0].output = \"biases\": the CPPN has no such output (it has intra, inter, bias, "
            "time_constant)");
  EXPECT_EQ(ctrnn([](Settings& s) { s.outputs.push_back("gain"); }),
            "outputs[4] = \"gain\": no link and no property reads it");
  EXPECT_EQ(ctrnn([](Settings& s) { s.outputs.push_back("bias"); }), "outputs[4] = \"bias\" is there twice");
  EXPECT_EQ(ctrnn([](Settings& s) { s.outputs.clear(); }), "outputs is empty: expected a list of names");
}

TEST(BadSubstrate, SensorOrJointThatTheRobotLacks) {
  EXPECT_EQ(ctrnn([](Settings& s) { s.nodes[0].sensor = "touch.ML"; }),
            "nodes[0].sensor = \"touch.ML\": the robot has no leg ML; expected FL, FR, BL, BR");
  EXPECT_EQ(ctrnn([](Settings& s) { s.nodes[0].sensor = "angle.FL_elbow"; }),
            "nodes[0].sensor = \"angle.FL_elbow\": the robot has no joint FL_elbow; expected FL_knee, "
            "FL_hip_fb, FL_hip_io, FR_knee and 8 more");
  EXPECT_EQ(ctrnn([](Settings& s) { s.nodes[0].sensor = "smell"; }),
            "nodes[0].sensor = \"smell\": expected angle.JOINT, touch.LEG, load.LEG, speed.JOINT, "
            "torque.JOINT, roll, "
            "pitch, yaw, yaw_rate, command_speed, command_turn, command_stop, heading_error or sine");
  EXPECT_EQ(ctrnn([](Settings& s) { s.nodes[3].joint = "FL_elbow"; }),
            "nodes[3].joint = \"FL_elbow\": the robot has no such joint; for nodes of its own joints: --set "
            "controller.substrate=auto");
}

TEST(BadSubstrate, JointDrivenTwiceOrNotAtAll) {
  EXPECT_EQ(ctrnn([](Settings& s) { s.nodes[4].joint = "FL_knee"; }),
            "nodes[4].joint = \"FL_knee\": \"FL.knee\" (nodes[3]) drives it already");
  EXPECT_EQ(ctrnn([](Settings& s) { s.nodes[4].joint = ""; }),
            "nodes: no node drives the robot's joint FL_hip_io; for nodes of its own joints: --set "
            "controller.substrate=auto");
  EXPECT_EQ(ctrnn([](Settings& s) { s.nodes[4].sensor = "roll"; }),
            "nodes[4]: \"FL.hip_io\" has both a sensor and a joint");
  EXPECT_EQ(ctrnn([](Settings& s) { s.nodes.clear(); }), "nodes is empty: a controller needs nodes");
}

TEST(BadSubstrate, WrongCoordinates) {
  EXPECT_EQ(ctrnn([](Settings& s) { s.nodes[5].at.pop_back(); }),
            "nodes[5].at: \"FL.hip_fb\" has 3 coordinates: expected 4 (x, y, module_x, module_y)");
  EXPECT_EQ(ctrnn([](Settings& s) { s.coordinates[1] = "x"; }), "coordinates[1] = \"x\" is there twice");
  EXPECT_EQ(ctrnn([](Settings& s) { s.links[0].same = {"module"}; }),
            "links[0].same: there is no coordinate \"module\" (there are x, y, module_x, module_y)");
  EXPECT_EQ(ctrnn([](Settings& s) { s.links[0].times = "side"; }),
            "links[0].times: there is no coordinate \"side\" (there are x, y, module_x, module_y)");
  EXPECT_EQ(supg([](Settings& s) { s.properties[1].zero = {"type"}; }),
            "properties[1].zero: there is no coordinate \"type\" (there are leg, joint_type)");
}

TEST(BadSubstrate, PropertyThatTheControllerDoesNotKnowOrThatIsMissing) {
  EXPECT_EQ(supg([](Settings& s) { s.properties[1].property = "bias"; }),
            "properties[1].property = \"bias\": nodes of a controller of kind supg have no such property: "
            "expected pattern or offset");
  EXPECT_EQ(supg([](Settings& s) { s.properties.pop_back(); }),
            "properties: \"FL.knee\" has no offset, which a controller of kind supg needs");
  EXPECT_EQ(ctrnn([](Settings& s) { s.properties.erase(s.properties.begin() + 1); }),
            "properties: \"FL.knee\" has no bias, which a controller of kind ctrnn needs");
  EXPECT_EQ(ctrnn([](Settings& s) { s.properties[0].of = "touch"; }),
            "properties[0].of: \"FL.touch\" is a sensor and has no bias");
  EXPECT_EQ(ctrnn([](Settings& s) { s.properties.push_back(s.properties[1]); }),
            "properties[6]: the bias of \"FL.knee\" is given already");
  EXPECT_EQ(supg([](Settings& s) { s.properties[0].output = ""; }),
            "properties[0].output is missing: a pattern is not constant");
}

TEST(BadSubstrate, LinksWithoutEffect) {
  EXPECT_EQ(ctrnn([](Settings& s) { s.links.push_back(a_link("FL.touch", "hidden", "inter")); }),
            "links[17]: \"FL.touch\" is linked to \"FL.hidden left\" already by links[0]");
  EXPECT_EQ(ctrnn([](Settings& s) { s.links[5].both_ways = true; }),
            "links[5]: \"FL.hidden right\" is linked to \"FL.hidden left\" already by links[5]");
  EXPECT_EQ(ctrnn([](Settings& s) { s.links[7].same = {"y"}; }),
            "links[7]: there is nothing to link from \"BL.knee\" to \"FL.hidden left\"");
}

TEST(BadSubstrate, NetworkAmongSupgs) {
  EXPECT_EQ(supg([](Settings& s) { s.links.push_back(a_link("FL.knee", "FR.knee", "weight")); }),
            "links: a controller of kind supg has no links");
  EXPECT_EQ(supg([](Settings& s) { s.nodes[0].joint = ""; }),
            "nodes[0]: \"FL.knee\" drives no joint: each node of a controller of kind supg must");
}

TEST(BadSubstrate, EmptyNamesAndEmptyLists) {
  EXPECT_EQ(ctrnn([](Settings& s) { s.coordinates.clear(); }),
            "coordinates is empty: expected a list of names");
  EXPECT_EQ(ctrnn([](Settings& s) { s.coordinates[3] = ""; }), "coordinates[3] is empty: expected a name");
  EXPECT_EQ(ctrnn([](Settings& s) { s.outputs[0] = ""; }), "outputs[0] is empty: expected a name");
  EXPECT_EQ(ctrnn([](Settings& s) { s.outputs[3] = s.outputs[0]; }), "outputs[3] = \"intra\" is there twice");
}

TEST(BadSubstrate, SensorWithoutAnOwnerOrOfAKindThatRobotsLack) {
  const std::string expected =
      "\": expected angle.JOINT, touch.LEG, load.LEG, speed.JOINT, torque.JOINT, roll, pitch, yaw, yaw_rate, "
      "command_speed, command_turn, command_stop, heading_error or sine";
  for (const std::string name : {"angle", "touch", "smell.FL", "roll.FL", "Angle.FL_knee"})
    EXPECT_EQ(ctrnn([&](Settings& s) { s.nodes[0].sensor = name; }),
              "nodes[0].sensor = \"" + name + expected);
  EXPECT_EQ(ctrnn([](Settings& s) { s.nodes[0].sensor = "touch.FL_knee"; }),
            "nodes[0].sensor = \"touch.FL_knee\": the robot has no leg FL_knee; expected FL, FR, BL, BR");
  EXPECT_EQ(ctrnn([](Settings& s) { s.nodes[0].sensor = "angle.FL"; }),
            "nodes[0].sensor = \"angle.FL\": the robot has no joint FL; expected FL_knee, FL_hip_fb, "
            "FL_hip_io, FR_knee and 8 more");
}

TEST(BadSubstrate, MoreThanAMillionLinks) {
  const auto with_nodes = [](int sources, int targets) {
    Settings settings = substrate_of(R"(coordinates = ["x"]
outputs = ["weight"]
links = [{from = "a", to = "b", weight = "weight"}]
nodes = [{name = "K", group = "b", at = [-1], joint = "L_knee"}])");
    for (int i = 0; i < sources + targets - 1; ++i) {
      auto& node = settings.nodes.emplace_back();
      node.name = std::to_string(i);
      node.group = i < sources ? "a" : "b";
      node.at = {static_cast<double>(i)};
    }
    return settings;
  };
  const Layout layout(with_nodes(1000, 1000), network_needs(), hopper());
  EXPECT_EQ(layout.links().size(), 1'000'000u);
  try {
    const Layout more(with_nodes(1001, 1000), network_needs(), hopper());
    FAIL();
  } catch (const SettingError& error) {
    EXPECT_STREQ(error.what(), "controller.substrate.links are more than 1000000");
  }
}

}  // namespace
}  // namespace amble::substrate
