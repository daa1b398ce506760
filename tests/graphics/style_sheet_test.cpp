#include "amble/graphics/style_sheet.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amble/graphics/svg.hpp"

namespace amble::graphics {
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
  // All that pages with a style of their own share, a figure needs as well.
  const std::string plots_and_maps = map_style_sheet(), shared = shared_style_sheet();
  EXPECT_THAT(svg, HasSubstr(plots_and_maps));
  const std::size_t half = shared.find("@media");
  ASSERT_NE(half, std::string::npos);
  EXPECT_THAT(svg, HasSubstr(shared.substr(0, half)));
}

TEST(StyleSheet, KnowsColoursByLightAndByDark) {
  for (const std::string& sheet :
       {style_sheet(), shared_style_sheet(), standalone_svg(Svg(4, 4, "").finish())}) {
    for (const char* name : {"--paper", "--ink", "--c0"}) EXPECT_THAT(sheet, HasSubstr(name));
    EXPECT_THAT(sheet, HasSubstr("prefers-color-scheme: dark"));
  }
  EXPECT_THAT(map_style_sheet(), Not(HasSubstr("prefers-color-scheme")));
}

TEST(StyleSheet, OfAPageHasWhatItsFiguresHave) {
  EXPECT_THAT(style_sheet(), HasSubstr(map_style_sheet()));
}

}  // namespace
}  // namespace amble::graphics
