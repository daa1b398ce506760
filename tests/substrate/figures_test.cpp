// The substrates of figures 4, 6 and 7 of Morse et al. 2013 against tables written by hand. The places are
// those of the authors' code.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "tests/substrate/fixture.hpp"

namespace amble::substrate {
namespace {

using Names = std::vector<std::string>;

/// A node as a table's line tells it: name, place, and what it senses ("<…") or drives (">…").
struct Line {
  std::string name;
  std::vector<double> at;
  std::string role;
};

std::string role_of(const Node& node, const robot::RobotSpec& robot) {
  if (node.joint >= 0) return ">" + robot.joints[static_cast<std::size_t>(node.joint)].name;
  if (!node.sensor) return "";
  const auto index = static_cast<std::size_t>(node.sensor->index);
  switch (node.sensor->kind) {
    case Sensor::Kind::angle:
      return "<" + robot.joints[index].name;
    case Sensor::Kind::touch:
      return "<" + robot.legs[index].name;
    case Sensor::Kind::roll:
      return "<roll";
    case Sensor::Kind::pitch:
      return "<pitch";
    case Sensor::Kind::yaw:
      return "<yaw";
    case Sensor::Kind::sine:
      return "<sine";
    case Sensor::Kind::speed:
    case Sensor::Kind::torque:
    case Sensor::Kind::yaw_rate:
    case Sensor::Kind::load:
    case Sensor::Kind::command_speed:
    case Sensor::Kind::command_turn:
    case Sensor::Kind::command_stop:
    case Sensor::Kind::heading_error:
      break;
  }
  return "?";
}

void expect_nodes(const Layout& layout, const std::vector<Line>& table) {
  const auto robot = controllers::quadruped();
  ASSERT_EQ(layout.nodes().size(), table.size());
  for (const Line& line : table) {
    const auto node =
        std::ranges::find_if(layout.nodes(), [&](const Node& n) { return n.name == line.name; });
    ASSERT_NE(node, layout.nodes().end()) << line.name;
    EXPECT_EQ(node->at, line.at) << line.name;
    EXPECT_EQ(role_of(*node, robot), line.role) << line.name;
  }
}

using Links = std::set<std::pair<std::string, std::string>>;

/// The links whose weights an output gives.
Links links_of(const Layout& layout, const std::string& output) {
  Links links;
  for (const Link& link : layout.links())
    if (layout.output_names()[static_cast<std::size_t>(link.output)] == output)
      links.emplace(layout.nodes()[static_cast<std::size_t>(link.source)].name,
                    layout.nodes()[static_cast<std::size_t>(link.target)].name);
  return links;
}

/// Both ways.
void connect(Links& links, const std::string& a, const std::string& b) {
  links.emplace(a, b);
  links.emplace(b, a);
}

TEST(Figure4, HasASupgPerJoint) {
  const Layout layout(part("supg"), supg_needs(), controllers::quadruped());
  // Leg: -1, -0.33, 0.33, 1 over 50, so that the legs' SUPGs of one type stand close together (the figure's
  // text; the divisor is the authors'). Type: knee -1, hip_fb 0, hip_io 1, far apart.
  expect_nodes(layout, {{"FL.knee", {-0.02, -1}, ">FL_knee"},
                        {"FL.hip_fb", {-0.02, 0}, ">FL_hip_fb"},
                        {"FL.hip_io", {-0.02, 1}, ">FL_hip_io"},
                        {"FR.knee", {-0.0066, -1}, ">FR_knee"},
                        {"FR.hip_fb", {-0.0066, 0}, ">FR_hip_fb"},
                        {"FR.hip_io", {-0.0066, 1}, ">FR_hip_io"},
                        {"BL.knee", {0.0066, -1}, ">BL_knee"},
                        {"BL.hip_fb", {0.0066, 0}, ">BL_hip_fb"},
                        {"BL.hip_io", {0.0066, 1}, ">BL_hip_io"},
                        {"BR.knee", {0.02, -1}, ">BR_knee"},
                        {"BR.hip_fb", {0.02, 0}, ">BR_hip_fb"},
                        {"BR.hip_io", {0.02, 1}, ">BR_hip_io"}});
  EXPECT_TRUE(layout.links().empty());
  // Section 3: the CPPN takes x, y and the time; its outputs are the pattern and the offset.
  EXPECT_EQ(layout.input_names(), (Names{"leg", "joint_type", "time"}));
  EXPECT_EQ(layout.output_names(), (Names{"pattern", "offset"}));
}

TEST(Figure4, IsQueriedAtTheQueryPointsOfTheAuthors) {
  const Layout layout(part("supg"), supg_needs(), controllers::quadruped());
  std::set<std::vector<float>> points;
  for (int i = 0; i < layout.points().count(); ++i)
    points.insert({layout.points().get(i, 0), layout.points().get(i, 1), layout.points().get(i, 2)});
  std::set<std::vector<float>> expected;
  for (const float leg : {-0.02f, -0.0066f, 0.0066f, 0.02f}) {
    for (const float type : {-1.0f, 0.0f, 1.0f})
      for (int tick = 0; tick <= 100; ++tick) expected.insert({leg, type, static_cast<float>(tick) / 100.0f});
    expected.insert({leg, 0.0f, 0.0f});  // the offset: type and time count as 0 (section 3)
  }
  EXPECT_EQ(points, expected);
  EXPECT_EQ(static_cast<int>(points.size()), layout.points().count()) << "none is queried twice";
  // The SUPGs of a leg share their offset, those of different legs do not.
  const auto driver = [&](int joint) { return layout.driver(joint); };
  EXPECT_TRUE(layout.shared("offset", driver(0), driver(1)));
  EXPECT_TRUE(layout.shared("offset", driver(9), driver(11)));
  EXPECT_FALSE(layout.shared("offset", driver(2), driver(3)));
}

TEST(Figure6, HasThreePlanesOfRowsOfLegs) {
  const Layout layout(part("sine"), network_needs(), controllers::quadruped());
  // Layers -1 (input), 0 (hidden), 1 (output). Rows: FL -1, FR -0.5, BL 0.5, BR 1. Columns -1, -0.5, 0,
  // 0.5, 1.
  std::vector<Line> table{// FL: its angles, its touch, and the body's pitch.
                          {"FL.hip_fb angle", {-1, -1, -1}, "<FL_hip_fb"},
                          {"FL.hip_io angle", {-1, -1, -0.5}, "<FL_hip_io"},
                          {"FL.knee angle", {-1, -1, 0}, "<FL_knee"},
                          {"FL.touch", {-1, -1, 0.5}, "<FL"},
                          {"pitch", {-1, -1, 1}, "<pitch"},
                          // FR: and roll.
                          {"FR.hip_fb angle", {-1, -0.5, -1}, "<FR_hip_fb"},
                          {"FR.hip_io angle", {-1, -0.5, -0.5}, "<FR_hip_io"},
                          {"FR.knee angle", {-1, -0.5, 0}, "<FR_knee"},
                          {"FR.touch", {-1, -0.5, 0.5}, "<FR"},
                          {"roll", {-1, -0.5, 1}, "<roll"},
                          // BL: and yaw.
                          {"BL.hip_fb angle", {-1, 0.5, -1}, "<BL_hip_fb"},
                          {"BL.hip_io angle", {-1, 0.5, -0.5}, "<BL_hip_io"},
                          {"BL.knee angle", {-1, 0.5, 0}, "<BL_knee"},
                          {"BL.touch", {-1, 0.5, 0.5}, "<BL"},
                          {"yaw", {-1, 0.5, 1}, "<yaw"},
                          // BR: and the sine.
                          {"BR.hip_fb angle", {-1, 1, -1}, "<BR_hip_fb"},
                          {"BR.hip_io angle", {-1, 1, -0.5}, "<BR_hip_io"},
                          {"BR.knee angle", {-1, 1, 0}, "<BR_knee"},
                          {"BR.touch", {-1, 1, 0.5}, "<BR"},
                          {"sine", {-1, 1, 1}, "<sine"},
                          // Motors of a left leg from left to right: knee, in/out, forward/backward; of a
                          // right leg mirrored, so that both knees are outside.
                          {"FL.knee", {1, -1, -1}, ">FL_knee"},
                          {"FL.hip_io", {1, -1, -0.5}, ">FL_hip_io"},
                          {"FL.hip_fb", {1, -1, 0}, ">FL_hip_fb"},
                          {"FR.hip_fb", {1, -0.5, -1}, ">FR_hip_fb"},
                          {"FR.hip_io", {1, -0.5, -0.5}, ">FR_hip_io"},
                          {"FR.knee", {1, -0.5, 0}, ">FR_knee"},
                          {"BL.knee", {1, 0.5, -1}, ">BL_knee"},
                          {"BL.hip_io", {1, 0.5, -0.5}, ">BL_hip_io"},
                          {"BL.hip_fb", {1, 0.5, 0}, ">BL_hip_fb"},
                          {"BR.hip_fb", {1, 1, -1}, ">BR_hip_fb"},
                          {"BR.hip_io", {1, 1, -0.5}, ">BR_hip_io"},
                          {"BR.knee", {1, 1, 0}, ">BR_knee"}};
  // Twenty hidden nodes, on the same grid.
  const std::vector<std::pair<std::string, double>> rows{{"FL", -1}, {"FR", -0.5}, {"BL", 0.5}, {"BR", 1}};
  const std::vector<std::pair<std::string, double>> columns{
      {"1", -1}, {"2", -0.5}, {"3", 0}, {"4", 0.5}, {"5", 1}};
  for (const auto& [leg, row] : rows)
    for (const auto& [number, column] : columns)
      table.push_back({leg + ".hidden " + number, {0, row, column}, ""});
  expect_nodes(layout, table);
  // "six (two sets of three) inputs for the x and y position and layer, and a single output" (figure 6).
  EXPECT_EQ(layout.input_names(), (Names{"source.layer", "source.row", "source.column", "target.layer",
                                         "target.row", "target.column"}));
  EXPECT_EQ(layout.output_names(), (Names{"weight"}));
}

TEST(Figure6, LinksEveryInputToEveryHiddenNodeAndTheseToEveryMotor) {
  const Layout layout(part("sine"), network_needs(), controllers::quadruped());
  Links expected;
  for (const Node& a : layout.nodes())
    for (const Node& b : layout.nodes())
      if ((a.at[0] == -1 && b.at[0] == 0) || (a.at[0] == 0 && b.at[0] == 1)) expected.emplace(a.name, b.name);
  EXPECT_EQ(expected.size(), 20u * 20u + 20u * 12u);
  EXPECT_EQ(links_of(layout, "weight"), expected);
  EXPECT_EQ(layout.links().size(), 640u);
}

TEST(Figure7, HasAModulePerLeg) {
  const Layout layout(part("ctrnn"), ctrnn_needs(), controllers::quadruped());
  // In a module: touch (0, -1), hidden (-1, 0) and (1, 0), motors (-1, 1), (0, 1), (1, 1). Modules: front
  // y = 1, left x = -1. Motors of a left leg from left to right: knee, in/out, forward/backward; of a right
  // leg mirrored.
  expect_nodes(layout,
               {{"FL.touch", {0, -1, -1, 1}, "<FL"},         {"FL.hidden left", {-1, 0, -1, 1}, ""},
                {"FL.hidden right", {1, 0, -1, 1}, ""},      {"FL.knee", {-1, 1, -1, 1}, ">FL_knee"},
                {"FL.hip_io", {0, 1, -1, 1}, ">FL_hip_io"},  {"FL.hip_fb", {1, 1, -1, 1}, ">FL_hip_fb"},
                {"FR.touch", {0, -1, 1, 1}, "<FR"},          {"FR.hidden left", {-1, 0, 1, 1}, ""},
                {"FR.hidden right", {1, 0, 1, 1}, ""},       {"FR.hip_fb", {-1, 1, 1, 1}, ">FR_hip_fb"},
                {"FR.hip_io", {0, 1, 1, 1}, ">FR_hip_io"},   {"FR.knee", {1, 1, 1, 1}, ">FR_knee"},
                {"BL.touch", {0, -1, -1, -1}, "<BL"},        {"BL.hidden left", {-1, 0, -1, -1}, ""},
                {"BL.hidden right", {1, 0, -1, -1}, ""},     {"BL.knee", {-1, 1, -1, -1}, ">BL_knee"},
                {"BL.hip_io", {0, 1, -1, -1}, ">BL_hip_io"}, {"BL.hip_fb", {1, 1, -1, -1}, ">BL_hip_fb"},
                {"BR.touch", {0, -1, 1, -1}, "<BR"},         {"BR.hidden left", {-1, 0, 1, -1}, ""},
                {"BR.hidden right", {1, 0, 1, -1}, ""},      {"BR.hip_fb", {-1, 1, 1, -1}, ">BR_hip_fb"},
                {"BR.hip_io", {0, 1, 1, -1}, ">BR_hip_io"},  {"BR.knee", {1, 1, 1, -1}, ">BR_knee"}});
  // "the eight (four for each node) coordinates", "separate CPPN outputs for inter-module connections,
  // intra-module connections, node bias, and node time constant" (figure 7).
  EXPECT_EQ(layout.input_names(), (Names{"source.x", "source.y", "source.module_x", "source.module_y",
                                         "target.x", "target.y", "target.module_x", "target.module_y"}));
  EXPECT_EQ(layout.output_names(), (Names{"intra", "inter", "bias", "time_constant"}));
}

TEST(Figure7, LinksTheNodesOfAModule) {
  const Layout layout(part("ctrnn"), ctrnn_needs(), controllers::quadruped());
  Links expected;
  for (const std::string leg : {"FL.", "FR.", "BL.", "BR."}) {
    const std::string touch = leg + "touch", left = leg + "hidden left", right = leg + "hidden right",
                      knee = leg + "knee", io = leg + "hip_io", fb = leg + "hip_fb";
    for (const auto& to : {left, right, knee, io, fb}) expected.emplace(touch, to);  // the sensor feeds all
    for (const auto& to : {knee, io, fb}) {
      expected.emplace(left, to);
      expected.emplace(right, to);
    }
    connect(expected, left, right);
    // The middle motor (in/out) and the outer ones.
    connect(expected, io, knee);
    connect(expected, io, fb);
  }
  EXPECT_EQ(expected.size(), 4u * (5 + 6 + 2 + 4));
  EXPECT_EQ(links_of(layout, "intra"), expected);
}

TEST(Figure7, LinksNeighbouringModules) {
  const Layout layout(part("ctrnn"), ctrnn_needs(), controllers::quadruped());
  Links expected;
  // Behind and in front of each other: what faces the front module are the back module's motors, and what
  // faces the back module are the front module's hidden nodes and its touch sensor, from left to right.
  connect(expected, "BL.knee", "FL.hidden left");
  connect(expected, "BL.hip_io", "FL.touch");
  connect(expected, "BL.hip_fb", "FL.hidden right");
  connect(expected, "BR.hip_fb", "FR.hidden left");
  connect(expected, "BR.hip_io", "FR.touch");
  connect(expected, "BR.knee", "FR.hidden right");
  // Beside each other: the hidden nodes and the motors that face each other.
  connect(expected, "FL.hidden right", "FR.hidden left");
  connect(expected, "FL.hip_fb", "FR.hip_fb");
  connect(expected, "BL.hidden right", "BR.hidden left");
  connect(expected, "BL.hip_fb", "BR.hip_fb");
  EXPECT_EQ(expected.size(), 20u);
  EXPECT_EQ(links_of(layout, "inter"), expected);
  EXPECT_EQ(layout.links().size(), 88u);
}

}  // namespace
}  // namespace amble::substrate
