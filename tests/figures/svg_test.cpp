#include "amble/figures/svg.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "tests/figures/xml.hpp"

namespace amble::figures {
namespace {

TEST(Number, HasAPointAndNoTrailingZeros) {
  EXPECT_EQ(number(1.5), "1.5");
  EXPECT_EQ(number(1.0), "1");
  EXPECT_EQ(number(100.0), "100");
  EXPECT_EQ(number(1234.567), "1234.57");
  EXPECT_EQ(number(1234.567, 0), "1235");
  EXPECT_EQ(number(100.0, 0), "100");
}

TEST(Number, HasNoNegativeZero) {
  EXPECT_EQ(number(-0.0), "0");
  EXPECT_EQ(number(-0.001), "0");
  EXPECT_EQ(number(-0.01), "-0.01");
}

TEST(NumberDeathTest, RefusesWhatIsNotFinite) {
  EXPECT_DEATH(number(std::numeric_limits<double>::quiet_NaN()), "finite");
}

TEST(Svg, IsWellFormedWhateverTheTexts) {
  Svg svg(100, 50, "a \"description\" <with> & markup");
  svg.begin_group("leg0");
  svg.line({0, 1}, {2, 3.5}, "axis");
  svg.polygon(std::array<Point, 3>{{{0, 0}, {1, 0.25}, {-1, 1}}}, "shape");
  svg.text({5, 6}, Anchor::end, "label", "1 < 2 & 3");
  svg.end_group();
  svg.circle({1, 2}, 3);
  svg.rect({1, 2, 3, 4}, "bar", 1.5);
  const auto elements = tests::parse_xml(svg.finish());
  ASSERT_EQ(elements.size(), 7u);
  EXPECT_EQ(elements[0].attributes.at("viewBox"), "0 0 100 50");
  EXPECT_EQ(elements[0].attributes.at("aria-label"), "a \"description\" <with> & markup");
  EXPECT_EQ(elements[2].number("y2"), 3.5);
  EXPECT_EQ(elements[4].text, "1 < 2 & 3");
  EXPECT_EQ(elements[4].attributes.at("text-anchor"), "end");
  EXPECT_EQ(elements[4].path, (std::vector<std::string>{"", "leg0", "label"}));
}

TEST(Svg, DrawsCurvesAndNamesGroups) {
  Svg svg(10, 10, "");
  svg.begin_group("wire", "a → b & c");
  svg.bezier(std::array<Point, 7>{{{0, 0}, {1.25, 2}, {3, -4}, {5, 6}, {7, 7}, {8, 8}, {9, 9}}}, {}, 1.5);
  svg.bezier(std::array<Point, 4>{{{0, 0}, {1, 1}, {2, 2}, {3, 3}}}, "glyph");
  svg.end_group();
  const auto elements = tests::parse_xml(svg.finish());
  ASSERT_EQ(elements.size(), 5u);
  EXPECT_EQ(elements[2].name, "title");
  EXPECT_EQ(elements[2].text, "a → b & c");
  EXPECT_EQ(elements[3].attributes.at("d"), "M0 0 C1.2 2 3 -4 5 6 C7 7 8 8 9 9");
  EXPECT_EQ(elements[3].number("stroke-width"), 1.5);
  EXPECT_FALSE(elements[4].attributes.contains("stroke-width"));
}

TEST(SvgDeathTest, RefusesAGroupThatIsNotEnded) {
  EXPECT_DEATH(
      {
        Svg svg(1, 1, "");
        svg.begin_group("a");
        svg.finish();
      },
      "still open");
}

}  // namespace
}  // namespace amble::figures
