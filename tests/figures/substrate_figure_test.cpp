#include "amble/figures/substrate_figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "amble/figures/substrate_graph.hpp"
#include "tests/figures/xml.hpp"
#include "tests/motion/fixture.hpp"

namespace amble::figures {
namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

/// All places of a grid of −1, 0, 1 in each coordinate; the first node senses, the last drives a joint.
Substrate grid(std::size_t coordinates) {
  Substrate substrate;
  const std::vector<std::string> names{"layer", "row", "column", "depth", "time"};
  substrate.coordinates.assign(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(coordinates));
  const int count = static_cast<int>(std::pow(3, coordinates));
  for (int i = 0; i < count; ++i) {
    motion::NetworkNode& node = substrate.nodes.emplace_back();
    node.name = "node " + std::to_string(i);
    for (int rest = i; node.at.size() < coordinates; rest /= 3) node.at.push_back(rest % 3 - 1);
  }
  substrate.nodes.front().role = motion::NodeRole::sensor;
  substrate.nodes.back().role = motion::NodeRole::joint;
  substrate.link_kinds = {"inner", "outer"};
  substrate.links = {{0, 1, 0, 1.0}, {1, count - 1, 1, 0.1}, {1, 1, 1, 0.5}};
  return substrate;
}

/// Middles of the circles that are nodes, and of the boxes of sensors.
std::set<std::pair<double, double>> node_places(const std::vector<tests::XmlElement>& elements) {
  std::set<std::pair<double, double>> places;
  for (const char* role : {"node-hidden", "node-joint"})
    for (const auto& circle : tests::with_class(elements, role))
      places.emplace(circle.number("cx"), circle.number("cy"));
  for (const auto& box : tests::with_class(elements, "node-sensor"))
    places.emplace(box.number("x") + 0.5 * box.number("width"), box.number("y") + 0.5 * box.number("height"));
  return places;
}

TEST(SubstrateFigure, GivesEveryNodeAPlaceOfItsOwnInsideThePicture) {
  for (std::size_t coordinates = 1; coordinates <= 4; ++coordinates)
    for (const FigureSize layout : {FigureSize::wide, FigureSize::narrow}) {
      const Substrate substrate = grid(coordinates);
      const auto elements = tests::parse_xml(substrate_figure(substrate, layout));
      const auto places = node_places(elements);
      // The legend of the wide picture has one of each of the three roles.
      EXPECT_EQ(places.size(), substrate.nodes.size() + (layout == FigureSize::wide ? 3 : 0)) << coordinates;
      for (const auto& [x, y] : places) {
        EXPECT_GT(x, 0.0);
        EXPECT_LT(x, width_px(layout));
        EXPECT_GT(y, 0.0);
        EXPECT_LT(y, elements.front().number("height"));
      }
    }
}

TEST(SubstrateFigure, DrawsLinksInTheColoursOfTheirKindsWithHeads) {
  const auto elements = tests::parse_xml(substrate_figure(grid(2), FigureSize::narrow));
  const auto links = tests::with_class(elements, "link");
  ASSERT_EQ(links.size(), 2u);
  EXPECT_EQ(links[0].path.at(1), "leg0");
  EXPECT_EQ(links[1].path.at(1), "leg1");
  EXPECT_EQ(tests::with_class(elements, "strong").size(), 1u);
  EXPECT_EQ(tests::with_class(elements, "weak").size(), 1u);
  EXPECT_EQ(tests::with_class(elements, "arrow").size(), 2u);
  EXPECT_EQ(tests::with_class(elements, "loop").size(), 1u) << "a link to itself";
}

TEST(SubstrateFigure, HasALegendOfAsManyRowsAsItNeeds) {
  Substrate substrate = grid(2);
  substrate.link_kinds.assign(14, "coupling between legs");
  substrate.links.clear();
  for (int kind = 0; kind < 14; ++kind) substrate.links.push_back({0, 1, kind, 0.1});
  const auto elements = tests::parse_xml(substrate_figure(substrate, FigureSize::wide));
  std::set<double> rows;
  for (const auto& mark : tests::with_class(elements, "strong")) {
    EXPECT_LT(mark.number("x2") + 12.0 + 7.0 * 21, width_px(FigureSize::wide));
    rows.insert(mark.number("y2"));
  }
  EXPECT_GT(rows.size(), 1u);
  for (const auto& [x, y] : node_places(elements))
    EXPECT_FALSE(y > *rows.rbegin() && y < *rows.rbegin() + 18.0) << "between the legend and the network";
}

TEST(SubstrateFigure, DrawsNoTwoKindsAlike) {
  Substrate substrate = grid(2);
  substrate.link_kinds.clear();
  substrate.links.clear();
  for (int kind = 0; kind < 14; ++kind) {
    substrate.link_kinds.push_back("kind " + std::to_string(kind));
    substrate.links.push_back({0, 1, kind, 1.0});
  }
  const auto elements = tests::parse_xml(substrate_figure(substrate, FigureSize::wide));
  std::map<std::vector<std::string>, int> looks;
  for (const auto& mark : tests::with_class(elements, "strong")) ++looks[mark.path];
  EXPECT_EQ(looks.size(), 14u);
  for (const auto& [look, count] : looks) EXPECT_EQ(count, 2) << "a link, and its mark in the legend";
}

TEST(SubstrateFigure, DashesLinksOfNegativeWeightAndSaysSo) {
  Substrate substrate = grid(2);
  substrate.links[1].negative = true;
  const auto elements = tests::parse_xml(substrate_figure(substrate, FigureSize::wide));
  EXPECT_EQ(tests::with_class(elements, "dashed").size(), 2u) << "one link, and one mark in the legend";
  EXPECT_THAT(tests::texts(elements), testing::Contains("dashed: of negative weight"));
  EXPECT_THAT(tests::texts(tests::parse_xml(substrate_figure(grid(2), FigureSize::wide))),
              Not(testing::Contains("dashed: of negative weight")));
}

TEST(SubstrateFigure, LetsNoNameCoverAnotherOrStandOut) {
  Substrate substrate = grid(4);
  for (std::size_t i = 0; i < substrate.nodes.size(); ++i)
    substrate.nodes[i].name = "middle_left.hidden " + std::to_string(i);
  const auto elements = tests::parse_xml(substrate_figure(substrate, FigureSize::wide));
  const auto names = tests::with_class(elements, "tiny");
  ASSERT_EQ(names.size(), substrate.nodes.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto wide_px = [](const tests::XmlElement& name) {
      return 5.2 * static_cast<double>(name.text.size());
    };
    EXPECT_LE(names[i].number("x") + wide_px(names[i]), width_px(FigureSize::wide));
    for (std::size_t k = 0; k < i; ++k) {
      const double left = std::max(names[i].number("x"), names[k].number("x"));
      const double right =
          std::min(names[i].number("x") + wide_px(names[i]), names[k].number("x") + wide_px(names[k]));
      EXPECT_TRUE(left >= right || std::fabs(names[i].number("y") - names[k].number("y")) > 10.0)
          << names[i].text << " and " << names[k].text;
    }
  }
}

TEST(SubstrateFigure, PutsAFrameAroundEachPlaneAndModule) {
  EXPECT_EQ(tests::with_class(tests::parse_xml(substrate_figure(grid(2), FigureSize::wide)), "plane").size(),
            1u);
  EXPECT_EQ(tests::with_class(tests::parse_xml(substrate_figure(grid(3), FigureSize::wide)), "plane").size(),
            3u);
  EXPECT_EQ(tests::with_class(tests::parse_xml(substrate_figure(grid(4), FigureSize::wide)), "plane").size(),
            9u);
}

TEST(SubstrateFigure, PutsNodesInTheDirectionsOfTheirCoordinates) {
  // Where larger coordinates are: right, up, or both, where planes are seen from the side.
  struct Direction {
    int right, up;
  };
  const std::vector<std::vector<Direction>> directions{
      {{1, 0}}, {{1, 0}, {0, 1}}, {{0, 1}, {1, 1}, {1, 0}}, {{1, 0}, {0, 1}, {1, 0}, {0, 1}}};
  const auto sign = [](double value) { return std::fabs(value) < 1e-9 ? 0 : value > 0.0 ? 1 : -1; };
  for (std::size_t coordinates = 1; coordinates <= 4; ++coordinates) {
    const Substrate substrate = grid(coordinates);
    const auto nodes = substrate_places(substrate, 600.0, 20.0).nodes;
    ASSERT_EQ(nodes.size(), substrate.nodes.size());
    std::size_t stride = 1;
    for (std::size_t axis = 0; axis < coordinates; ++axis, stride *= 3)
      for (std::size_t i = 0; i + stride < nodes.size(); ++i) {
        if (substrate.nodes[i].at[axis] == 1) continue;
        EXPECT_EQ(sign(nodes[i + stride].x - nodes[i].x), directions[coordinates - 1][axis].right)
            << coordinates << " " << axis << " " << i;
        EXPECT_EQ(sign(nodes[i].y - nodes[i + stride].y), directions[coordinates - 1][axis].up)
            << coordinates << " " << axis << " " << i;
      }
  }
}

TEST(SubstrateFigure, NamesNodesPlanesRolesAndKinds) {
  const auto words = tests::texts(tests::parse_xml(substrate_figure(grid(3), FigureSize::wide)));
  EXPECT_THAT(words, IsSupersetOf({"node 0", "node 26", "layer = −1", "layer = 1", "sensor", "hidden",
                                   "drives a joint", "inner", "outer"}));
}

TEST(SubstrateFigure, TakesNodesThatAgreeInACoordinate) {
  Substrate substrate = grid(4);
  for (motion::NetworkNode& node : substrate.nodes) node.at[0] = node.at[3] = 0.5;
  tests::parse_xml(substrate_figure(substrate, FigureSize::wide));
}

TEST(SubstrateFigure, RefusesMoreCoordinatesThanItCanShow) {
  EXPECT_EQ(tests::error_of([] { substrate_figure(grid(5), FigureSize::wide); }),
            "a substrate with 5 coordinates cannot be drawn: expected at most 4");
}

TEST(SubstrateFigure, IsAFileOfItsOwnWithItsStyle) {
  const std::string svg = substrate_svg(grid(2));
  EXPECT_THAT(svg, HasSubstr("<style>"));
  EXPECT_THAT(substrate_figure(grid(2), FigureSize::wide), Not(HasSubstr("<style>")));
  tests::parse_xml(svg);
}

}  // namespace
}  // namespace amble::figures
