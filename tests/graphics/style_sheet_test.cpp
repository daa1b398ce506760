#include "amble/graphics/style_sheet.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace amble::graphics {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(StyleSheet, GoesIntoTheTagOfAFigureThatIsAFileOfItsOwn) {
  const std::string svg = standalone_svg("<svg width=\"4\"><g class=\"plot\"></g></svg>");
  EXPECT_THAT(svg, StartsWith("<svg width=\"4\">\n<style>"));
  EXPECT_TRUE(svg.ends_with("</style><g class=\"plot\"></g></svg>")) << svg;
  // All that pages with a style of their own share, a figure needs as well.
  const std::string plots_and_maps = map_style_sheet(), shared = shared_style_sheet();
  EXPECT_THAT(svg, HasSubstr(plots_and_maps));
  const std::size_t half = shared.find("@media");
  ASSERT_NE(half, std::string::npos);
  EXPECT_THAT(svg, HasSubstr(shared.substr(0, half)));
}

TEST(StyleSheet, KnowsColoursByLightAndByDark) {
  for (const std::string& sheet : {style_sheet(), shared_style_sheet(), standalone_svg("<svg></svg>")}) {
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
