#include "amble/figures/style_sheet.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amble/figures/svg.hpp"

namespace amble::figures {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(StyleSheet, GoesIntoTheTagOfAFigureThatIsAFileOfItsOwn) {
  Svg figure(40, 20.5, "figure");
  figure.line({0, 0}, {40, 20.5});
  const std::string element = figure.finish(), svg = standalone_svg(element);
  // The paper goes on around the figure: nothing is cut where it is shown as an image of its own size.
  EXPECT_THAT(svg,
              StartsWith("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-16 -16 72 52.5\" width=\"72\" "
                         "height=\"52.5\" role=\"img\" aria-label=\"figure\">\n<style>"));
  EXPECT_THAT(svg, Not(HasSubstr("svg { background: var(--paper); padding")));
  EXPECT_TRUE(svg.ends_with("</style>" + element.substr(element.find('>') + 1))) << svg;
}

TEST(StyleSheet, OfAFigureThatIsAFileOfItsOwnNeedsNoCustomProperties) {
  Svg figure(40, 20, "figure");
  figure.begin_group("leg1");
  figure.line({0, 0}, {40, 20}, "curve");
  figure.end_group();
  const std::string svg =
      standalone_svg(figure.finish(), ".mine { fill: var(--ink); }\n.curve.x { stroke: var(--c4); }");
  EXPECT_THAT(svg, Not(HasSubstr("var(")));
  EXPECT_THAT(svg, HasSubstr("svg text { font: 13px system-ui, "));
  // Curves have the colour of their leg, light and dark, and no other leg and no other class has a rule.
  const std::size_t dark = svg.find("prefers-color-scheme: dark");
  EXPECT_THAT(svg, HasSubstr(".curve { fill: none; stroke: currentColor; stroke-width: 2.4;"));
  EXPECT_THAT(svg.substr(0, dark), HasSubstr("svg .leg1 { color: #c2410c; }"));
  EXPECT_THAT(svg.substr(dark), HasSubstr("svg .leg1 { color: #f0713a; }"));
  EXPECT_THAT(svg.substr(dark), HasSubstr(".curve.x { stroke: #35b3a2; }"));
  EXPECT_THAT(svg.substr(dark), Not(HasSubstr(".curve { fill")));
  for (const char* other : {"leg0", ".stance", ".mine"}) EXPECT_THAT(svg, Not(HasSubstr(other)));
}

TEST(StyleSheet, KnowsColoursByLightAndByDark) {
  for (const std::string& sheet : {style_sheet(), shared_style_sheet()}) {
    for (const char* name : {"--paper", "--ink", "--c0"}) EXPECT_THAT(sheet, HasSubstr(name));
    EXPECT_THAT(sheet, HasSubstr("prefers-color-scheme: dark"));
  }
  EXPECT_THAT(map_style_sheet(), Not(HasSubstr("prefers-color-scheme")));
}

TEST(StyleSheet, OfAPageHasWhatItsFiguresHave) {
  EXPECT_THAT(style_sheet(), HasSubstr(map_style_sheet()));
}

}  // namespace
}  // namespace amble::figures
