#include "amble/figures/footfall_figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/figures/xml.hpp"
#include "tests/motion/fixture.hpp"

namespace amble::figures {
namespace {

using testing::Contains;

std::vector<tests::XmlElement> in_leg(const std::vector<tests::XmlElement>& elements,
                                      const std::string& leg) {
  std::vector<tests::XmlElement> found;
  for (const auto& element : elements)
    if (testing::Matches(Contains(leg))(element.path)) found.push_back(element);
  return found;
}

TEST(FootfallFigure, DrawsBarsFromTouchDownToLiftOff) {
  // 4 s, too short to be enlarged: the axis runs from 40 to 904 px, 216 px per second.
  auto recorded = tests::walk(40);
  recorded.motion.touch[1].assign(40, false);
  for (std::size_t k = 9; k < 19; ++k) recorded.motion.touch[1][k] = true;  // from 1.0 s to 2.0 s
  const auto elements = tests::parse_xml(footfall_figure(recorded.robot, recorded.motion, FigureSize::wide));
  const auto bars = in_leg(tests::with_class(elements, "stance"), "leg1");
  ASSERT_EQ(bars.size(), 2u);  // the first is the mark beside the name
  EXPECT_NEAR(bars[1].number("x"), 40 + 216, 0.01);
  EXPECT_NEAR(bars[1].number("width"), 216, 0.01);
  EXPECT_THAT(tests::texts(elements), Contains("25 %"));
}

TEST(FootfallFigure, EnlargesTheLastSecondsOfALongerWalk) {
  auto recorded = tests::walk(100);
  for (auto& touch : recorded.motion.touch) touch.assign(100, false);
  recorded.motion.touch[2][79] = true;  // at 8.0 s, in both diagrams
  recorded.motion.touch[2][19] = true;  // at 2.0 s, before the last four seconds
  const auto elements = tests::parse_xml(footfall_figure(recorded.robot, recorded.motion, FigureSize::wide));
  const auto bars = in_leg(tests::with_class(elements, "stance"), "leg2");
  ASSERT_EQ(bars.size(), 2u + 3u);
  EXPECT_NEAR(bars[4].number("x"), 40 + 864 * (8.0 - 6.0) / 4.0, 0.01);
  EXPECT_NEAR(bars[4].number("width"), 864 * 0.1 / 4.0, 0.01);
}

TEST(FootfallFigure, MarksEachTriggerWhereItsBarBegins) {
  const auto recorded = tests::walk(40);
  const auto elements = tests::parse_xml(footfall_figure(recorded.robot, recorded.motion, FigureSize::wide));
  const auto bars = in_leg(tests::with_class(elements, "stance"), "leg0");
  const auto marks = in_leg(tests::with_class(elements, "trigger"), "leg0");
  ASSERT_EQ(marks.size(), 9u);
  for (std::size_t i = 0; i < marks.size(); ++i)
    EXPECT_NEAR(tests::points(marks[i])[2].first, bars[i + 2].number("x"), 0.06) << i;
}

TEST(FootfallFigure, TakesOneFrameOtherLegCountsAndNoTriggers) {
  for (const int legs : {1, 2, 6, 9})
    for (const FigureSize layout : {FigureSize::wide, FigureSize::narrow})
      for (const int frames : {1, 70}) {
        auto recorded = tests::walk(frames, legs);
        recorded.motion.trigger.clear();
        const auto elements = tests::parse_xml(footfall_figure(recorded.robot, recorded.motion, layout));
        EXPECT_TRUE(tests::with_class(elements, "trigger").empty());
        EXPECT_EQ(tests::with_class(elements, "track").size(),
                  static_cast<std::size_t>(frames == 1 ? legs : 2 * legs));
      }
}

}  // namespace
}  // namespace amble::figures
