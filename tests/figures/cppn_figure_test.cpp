#include "amble/figures/cppn_figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <sstream>
#include <utility>

#include "tests/figures/cppn_samples.hpp"
#include "tests/figures/xml.hpp"

namespace amble::figures {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;
using testing::StartsWith;

/// Widths of the lines in groups of this class, in their order, those of the legend left out.
std::vector<double> widths(const std::vector<tests::XmlElement>& elements, const std::string& css_class) {
  std::vector<double> found;
  bool in_link = false;
  for (const auto& element : elements) {
    if (element.name == "title") in_link = element.text.find("→") != std::string::npos;
    if (element.name == "text") in_link = false;
    if (in_link && element.name == "path" && element.path.size() >= 2 &&
        element.path[element.path.size() - 2].find(css_class) != std::string::npos)
      found.push_back(element.number("stroke-width"));
  }
  return found;
}

std::vector<std::string> titles(const std::vector<tests::XmlElement>& elements) {
  std::vector<std::string> found;
  for (const auto& element : elements)
    if (element.name == "title") found.push_back(element.text);
  return found;
}

TEST(CppnFigure, DrawsEachNodeAndItsFunction) {
  const auto elements = tests::parse_xml(cppn_figure(tests::cppn()));
  EXPECT_EQ(tests::with_class(elements, "neuron").size(), 4u);
  EXPECT_EQ(tests::with_class(elements, "terminal").size(), 3u);
  // Two strokes in each of four neurons, and in each of three functions of the legend.
  EXPECT_EQ(tests::with_class(elements, "glyph").size(), 2u * (4 + 3));
  EXPECT_THAT(tests::texts(elements),
              IsSupersetOf({"bias", "leg", "time", "pattern", "offset", "sigmoid", "Gaussian", "sine"}));
  EXPECT_THAT(tests::texts(elements), Not(Contains("linear"))) << "no node has it";
  EXPECT_THAT(titles(elements), IsSupersetOf({"pattern: sine", "node 9: gaussian", "leg"}));
}

TEST(CppnFigure, DrawsWeightsAsWidthsAndSignsAsColours) {
  const auto elements = tests::parse_xml(cppn_figure(tests::cppn()));
  // The heaviest, 3, is 6 px wide and comes first; others lie between it and 0.8 px in proportion.
  EXPECT_THAT(widths(elements, "plus"), testing::ElementsAre(6.0, 2.53, 2.1, 1.67));
  EXPECT_THAT(widths(elements, "minus"), testing::ElementsAre(3.4));
  EXPECT_THAT(widths(elements, "off"), testing::ElementsAre(2.1));
  EXPECT_THAT(titles(elements), IsSupersetOf({"node 12 → pattern: 3.000", "time → node 9: −1.500",
                                              "leg → offset: 0.750, disabled"}));
}

TEST(CppnFigure, DrawsCyclesAndLoops) {
  auto graph = tests::cppn();
  graph.links.push_back({6, 5, 1.0, true});
  graph.links.push_back({3, 3, 1.0, true});
  EXPECT_EQ(tests::with_class(tests::parse_xml(cppn_figure(graph)), "back").size(), 2u);
}

TEST(CppnFigure, StaysInsideItsPicture) {
  auto graph = tests::cppn();
  graph.nodes[1].name = "a_rather_long_name_of_an_input";
  for (std::uint32_t i = 0; i < 40; ++i) {
    graph.nodes.push_back({100 + i, CppnRole::hidden, "linear", ""});
    graph.links.push_back({graph.nodes.size() - 2, graph.nodes.size() - 1, 0.1, true});
  }
  const auto elements = tests::parse_xml(cppn_figure(graph));
  for (const auto& element : elements) {
    if (element.name != "circle") continue;
    EXPECT_GE(element.number("cx") - element.number("r"), 0.0);
    EXPECT_LE(element.number("cx") + element.number("r"), elements.front().number("width"));
    EXPECT_GE(element.number("cy") - element.number("r"), 0.0);
    EXPECT_LE(element.number("cy") + element.number("r"), elements.front().number("height"));
  }
}

/// Ends and control points of a path, between which its curves lie.
std::vector<std::pair<double, double>> bezier_corners(const tests::XmlElement& path) {
  std::string numbers = path.attributes.at("d");
  for (char& letter : numbers)
    if (letter == 'M' || letter == 'C' || letter == ',') letter = ' ';
  std::istringstream stream(numbers);
  std::vector<std::pair<double, double>> corners;
  for (double x = 0.0, y = 0.0; stream >> x >> y;) corners.emplace_back(x, y);
  EXPECT_TRUE(stream.eof()) << path.attributes.at("d");
  return corners;
}

/// Those of all links that lead back.
std::vector<std::pair<double, double>> detour_corners(const std::vector<tests::XmlElement>& elements) {
  std::vector<std::pair<double, double>> corners;
  for (const auto& element : elements) {
    if (element.name != "path" || element.path.size() < 2) continue;
    if (element.path[element.path.size() - 2].find(" back") == std::string::npos) continue;
    for (const auto& corner : bezier_corners(element)) corners.push_back(corner);
  }
  return corners;
}

TEST(CppnFigure, HasRoomForDetoursBetweenItsEdgesAndTheNamesOfItsOutputs) {
  auto graph = tests::cppn();
  std::size_t expected = 0;
  // More and more lanes beside the outputs, above and below.
  for (int round = 0; round < 6; ++round) {
    for (const auto& [from, to] : {std::pair{3, 4}, {4, 3}, {3, 5}, {4, 6}}) {
      graph.links.push_back({static_cast<std::size_t>(from), static_cast<std::size_t>(to), 1.0, true});
      ++expected;
    }
    const auto elements = tests::parse_xml(cppn_figure(graph));
    const auto corners = detour_corners(elements);
    ASSERT_GE(corners.size(), 4 * expected);
    double names = 0.0;
    for (const auto& element : elements)
      if (element.name == "text" && (element.text == "pattern" || element.text == "offset"))
        names = element.number("x");
    for (const auto& [x, y] : corners) {
      EXPECT_GE(x, 0.0);
      EXPECT_LT(x, names) << round;
      EXPECT_GE(y, 0.0);
      EXPECT_LE(y, elements.front().number("height"));
    }
    EXPECT_LT(names + 20.0, elements.front().number("width")) << "and for the names themselves";
  }
}

TEST(CppnFigure, DrawsFunctionsAsTheyRiseAndFall) {
  // Ends of the two strokes over the middle of their node: where they begin, meet and end; up is positive.
  const std::vector<std::pair<std::string, std::array<double, 3>>> functions{{"bipolar_sigmoid", {-6, 0, 6}},
                                                                             {"gaussian", {-6, 6, -6}},
                                                                             {"sine", {0, 0, 0}},
                                                                             {"linear", {-6, 0, 6}},
                                                                             {"|x|", {6, -6, 6}}};
  for (const auto& [function, heights] : functions) {
    auto graph = tests::cppn();
    for (auto& node : graph.nodes) node.function = function;
    const auto elements = tests::parse_xml(cppn_figure(graph));
    double middle = 0.0;
    std::vector<std::vector<double>> strokes;
    for (const auto& element : elements) {
      if (element.name == "circle") middle = element.number("cy");
      if (element.name != "path" || element.path.back() != "glyph") continue;
      std::vector<double> heights_px;
      for (const auto& [x, y] : bezier_corners(element)) heights_px.push_back(middle - y);
      if (strokes.size() < 2) strokes.push_back(heights_px);
    }
    ASSERT_EQ(strokes.size(), 2u);
    EXPECT_NEAR(strokes[0].front(), heights[0], 0.11) << function;
    EXPECT_NEAR(strokes[0].back(), heights[1], 0.11) << function;
    EXPECT_NEAR(strokes[1].front(), heights[1], 0.11) << function;
    EXPECT_NEAR(strokes[1].back(), heights[2], 0.11) << function;
    if (function == "sine") {
      EXPECT_GT(strokes[0][1], 5.0);
      EXPECT_LT(strokes[1][1], -5.0);
    }
  }
}

TEST(CppnFigure, NamesInputsOnTheLeftAndOutputsOnTheRightOfTheirNodes) {
  const auto elements = tests::parse_xml(cppn_figure(tests::cppn()));
  tests::XmlElement circle;
  int inputs = 0, outputs = 0;
  for (const auto& element : elements) {
    if (element.name == "circle") circle = element;
    if (element.name != "text") continue;
    const bool input = element.text == "bias" || element.text == "leg" || element.text == "time";
    const double edge = circle.number("cx") + (input ? -1.0 : 1.0) * circle.number("r");
    if (input) {
      EXPECT_LT(element.number("x"), edge) << element.text;
      EXPECT_EQ(element.attributes.at("text-anchor"), "end");
      ++inputs;
    } else if (element.text == "pattern" || element.text == "offset") {
      EXPECT_GT(element.number("x"), edge) << element.text;
      ++outputs;
    }
  }
  EXPECT_EQ(inputs, 3);
  EXPECT_EQ(outputs, 2);
}

TEST(CppnFigure, TakesACppnWithoutLinksAndNamesWithMarkup) {
  auto graph = tests::cppn();
  graph.links.clear();
  graph.nodes[1].name = "<leg & \"foot\">";
  EXPECT_THAT(tests::texts(tests::parse_xml(cppn_figure(graph))), Contains("<leg & \"foot\">"));
}

TEST(CppnFigure, IsAFileOfItsOwnWithItsStyle) {
  EXPECT_THAT(cppn_svg(tests::cppn()), StartsWith("<svg "));
  EXPECT_THAT(cppn_svg(tests::cppn()), HasSubstr(".wire.minus path"));
  EXPECT_THAT(cppn_figure(tests::cppn()), Not(HasSubstr("<style>")));
}

}  // namespace
}  // namespace amble::figures
