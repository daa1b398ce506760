#include "amble/figures/pattern_figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/figures/xml.hpp"
#include "tests/motion/fixture.hpp"

namespace amble::figures {
namespace {

using testing::Contains;
using testing::Not;

class PatternFigure : public testing::TestWithParam<FigureSize> {
 protected:
  static auto draw(const motion::RecordedTrial& recorded) {
    return tests::parse_xml(pattern_figure(recorded.robot, *recorded.supg, recorded.motion, GetParam()));
  }
};

TEST_P(PatternFigure, DrawsACurvePerJointAndTheOthersBehindIt) {
  const auto elements = draw(tests::walk(40));
  EXPECT_EQ(tests::with_class(elements, "curve").size(), 12u);
  EXPECT_EQ(tests::with_class(elements, "ghost").size(), 36u);
  for (const char* text : {"knee", "hip_fb", "hip_io", "FL", "BR"})
    EXPECT_THAT(tests::texts(elements), Contains(text));
}

TEST_P(PatternFigure, DrawsAnglesInProportionToTheJointsRange) {
  motion::RecordedTrial recorded = tests::walk(40);
  // The hip_fb of the first leg, in a row of 2 × 0.8 rad, goes from its lower stop to its upper.
  for (std::size_t tick = 0; tick <= 10; ++tick)
    recorded.supg->patterns_rad[1][tick] = -0.8 + 0.16 * static_cast<double>(tick);
  const auto elements = draw(recorded);
  const auto curve = tests::points(tests::with_class(elements, "curve").at(4));
  const auto range = tests::with_class(elements, "range").at(4);
  ASSERT_EQ(curve.size(), 11u);
  EXPECT_NEAR(curve.front().second, range.number("y") + range.number("height"), 0.06);
  EXPECT_NEAR(curve.back().second, range.number("y"), 0.06);
  EXPECT_NEAR(curve.front().first, range.number("x"), 0.06);
  EXPECT_NEAR(curve.back().first, range.number("x") + range.number("width"), 0.06);
}

TEST_P(PatternFigure, MarksTheOffsetOfEachLeg) {
  // Leg l starts at tick l + 1 of 10; a line in each of three rows and one in the row of triggers.
  const auto elements = draw(tests::walk(40));
  const auto offsets = tests::with_class(elements, "offset");
  const auto ranges = tests::with_class(elements, "range");
  ASSERT_EQ(offsets.size(), 16u);
  for (std::size_t leg = 0; leg < 4; ++leg)
    EXPECT_NEAR((offsets[leg].number("x1") - ranges[leg].number("x")) / ranges[leg].number("width"),
                0.1 * static_cast<double>(leg + 1), 1e-3);
}

TEST_P(PatternFigure, CountsTriggersByTheTimerTheyFound) {
  motion::RecordedTrial recorded = tests::walk(40);
  motion::Motion& motion = recorded.motion;
  for (auto& trigger : motion.trigger) trigger.assign(40, false);
  // Three triggers at tick 5 of 10, and one that finds the timer stopped.
  for (const std::size_t k : {10u, 20u, 30u, 35u}) {
    motion.trigger[0][k] = true;
    motion.timer_ticks[0][k - 1] = k == 35 ? -1.0f : 5.0f;
  }
  const auto elements = draw(recorded);
  std::vector<tests::XmlElement> bars;
  for (const auto& bar : tests::with_class(elements, "stance"))
    if (bar.number("y") > 10) bars.push_back(bar);  // the others name the legs
  ASSERT_EQ(bars.size(), 2u);
  EXPECT_NEAR(bars[0].number("height"), 3 * bars[1].number("height"), 0.02);
  const auto range = tests::with_class(elements, "range").at(0);
  EXPECT_NEAR((bars[0].number("x") - range.number("x")) / range.number("width"), 0.5, 0.05);
  EXPECT_GT(bars[1].number("x"), range.number("x") + range.number("width"));
  EXPECT_THAT(tests::texts(elements), Contains("3×"));
}

TEST_P(PatternFigure, TakesOtherLegCountsAndARecordingWithoutTimers) {
  for (const int legs : {1, 2, 6, 9}) {
    motion::RecordedTrial recorded = tests::walk(1, legs);
    EXPECT_THAT(tests::texts(draw(recorded)), Contains(testing::StartsWith("Timer when")));
    recorded.motion.timer_ticks.clear();
    const auto elements = draw(recorded);
    EXPECT_EQ(tests::with_class(elements, "curve").size(), static_cast<std::size_t>(3 * legs));
    EXPECT_THAT(tests::texts(elements), Not(Contains(testing::StartsWith("Timer when"))));
  }
}

TEST_P(PatternFigure, FillsItsWidthWithColumnsOfOneWidthUnderBarsOfTheirLegs) {
  constexpr double right_of_range_px = 14.0;  // the bin of stopped timers, and a margin behind the last leg
  for (const int legs : {1, 2, 4, 6}) {
    const auto elements = draw(tests::walk(1, legs));
    const auto ranges = tests::with_class(elements, "range");
    std::vector<tests::XmlElement> heads;
    for (const auto& bar : tests::with_class(elements, "stance"))
      if (bar.number("y") < 10) heads.push_back(bar);
    ASSERT_EQ(heads.size(), static_cast<std::size_t>(legs));
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      EXPECT_NEAR(ranges[i].number("x"), heads[i % heads.size()].number("x"), 0.02);
      EXPECT_NEAR(ranges[i].number("width"), heads[i % heads.size()].number("width"), 0.02);
      EXPECT_NEAR(ranges[i].number("width"), ranges[0].number("width"), 0.02);
    }
    EXPECT_NEAR(heads.back().number("x") + heads.back().number("width") + right_of_range_px,
                width_px(GetParam()), 0.02)
        << legs;
  }
}

TEST_P(PatternFigure, HasItsRowsOneBelowTheOtherAndNoRoomForMore) {
  for (const int legs : {1, 2, 4, 6})
    for (const bool timers : {true, false}) {
      motion::RecordedTrial recorded = tests::walk(1, legs);
      if (!timers) recorded.motion.timer_ticks.clear();
      const auto elements = draw(recorded);
      const auto titles = tests::with_class(elements, "title");
      ASSERT_EQ(titles.size(), timers ? 4u : 3u);
      const double apart = titles[1].number("y") - titles[0].number("y");
      EXPECT_GT(apart, 100.0);
      for (std::size_t i = 1; i < titles.size(); ++i)
        EXPECT_NEAR(titles[i].number("y") - titles[i - 1].number("y"), apart, 0.02) << legs;
      const double left = elements.front().number("height") - titles.back().number("y");
      EXPECT_GT(left, 60.0);
      EXPECT_LT(left, apart + 11.0) << legs;
    }
}

TEST(PatternSvg, ShowsThePatternsWithoutATrial) {
  const motion::RecordedTrial recorded = tests::walk(1);
  const std::string svg = pattern_svg(recorded.robot, *recorded.supg);
  EXPECT_THAT(svg, testing::HasSubstr("<style>"));
  const auto elements = tests::parse_xml(svg);
  EXPECT_EQ(tests::with_class(elements, "curve").size(), 12u);
  EXPECT_THAT(tests::texts(elements), Not(Contains(testing::StartsWith("Timer when"))));
}

INSTANTIATE_TEST_SUITE_P(Layouts, PatternFigure, testing::Values(FigureSize::wide, FigureSize::narrow));

}  // namespace
}  // namespace amble::figures
