#include "amble/figures/path_figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/figures/xml.hpp"
#include "tests/motion/fixture.hpp"

namespace amble::figures {
namespace {

using testing::Contains;

/// A bar's length in px and the metres it stands for.
double px_per_m(const std::vector<tests::XmlElement>& elements) {
  const auto bar = tests::with_class(elements, "scale-bar").at(0);
  for (const std::string& text : tests::texts(elements))
    if (text.ends_with(" m") && text.find("after") == std::string::npos)
      return (bar.number("x2") - bar.number("x1")) / std::stod(text);
  return 0.0;
}

TEST(PathFigure, HasEqualScalesThatTheBarStates) {
  // 3 m along x and 4 m along y, to the left.
  motion::RecordedTrial recorded = tests::walk(60);
  for (std::size_t k = 0; k < 60; ++k)
    recorded.motion.com_m[k] =
        recorded.motion.com_start_m + (static_cast<double>(k + 1) / 60) * Vec3{3, 4, 0};
  for (const FigureSize layout : {FigureSize::wide, FigureSize::narrow}) {
    const auto elements = tests::parse_xml(path_figure(recorded.robot, recorded.motion, layout));
    const auto start = tests::with_class(elements, "start").at(0),
               end = tests::with_class(elements, "end").at(0);
    const double right = end.number("cx") - start.number("cx"), down = end.number("cy") - start.number("cy");
    const double scale = px_per_m(elements);
    EXPECT_NEAR(right, scale * (layout == FigureSize::wide ? 3 : -4), 0.5);
    EXPECT_NEAR(down, -scale * (layout == FigureSize::wide ? 4 : 3), 0.5);
    EXPECT_THAT(tests::texts(elements), Contains("5.00 m after 6.0 s"));
  }
}

TEST(PathFigure, HasRoomForFeetFarFromThePath) {
  // The robot stands still, and its feet are metres away from its trunk.
  motion::RecordedTrial recorded = tests::walk(20);
  for (robot::Body& body : recorded.robot.bodies)
    if (body.parent == 0) body.position_m = 10.0 * body.position_m;
  for (Vec3& com_m : recorded.motion.com_m) com_m = recorded.motion.com_start_m;
  for (const FigureSize layout : {FigureSize::wide, FigureSize::narrow}) {
    const auto elements = tests::parse_xml(path_figure(recorded.robot, recorded.motion, layout));
    const auto prints = tests::with_class(elements, "footprint");
    ASSERT_FALSE(prints.empty());
    for (const auto& print : prints) {
      EXPECT_GE(print.number("cx"), 0.0);
      EXPECT_LE(print.number("cx"), elements.at(0).number("width"));
      EXPECT_GE(print.number("cy"), 0.0);
      EXPECT_LE(print.number("cy"), elements.at(0).number("height"));
    }
  }
}

TEST(PathFigure, MarksWhereFeetCameDown) {
  const motion::RecordedTrial recorded = tests::walk(20);
  const auto elements = tests::parse_xml(path_figure(recorded.robot, recorded.motion, FigureSize::wide));
  const auto prints = tests::with_class(elements, "footprint");
  ASSERT_EQ(prints.size(), 4u + 5u + 5u + 5u);
  // Leg 0 comes down in frames 4, 8, 12 and 16: at first 0.25 m on, then each 0.2 m, at x + 0.5 m and 0.2 m
  // to the left.
  const double scale = px_per_m(elements);
  const auto path = tests::points(tests::with_class(elements, "path").at(0));
  EXPECT_NEAR(prints[1].number("cx") - prints[0].number("cx"), 0.2 * scale, 0.1);
  const double com_x = recorded.motion.com_start_m.x;
  EXPECT_NEAR(prints[0].number("cx") - path[0].first, (0.25 + 0.5 - com_x) * scale, 0.1);
  EXPECT_NEAR(prints[0].number("cy") - path[0].second, -0.2 * scale, 0.1);
  EXPECT_EQ(prints[0].path.at(1), "leg0");
  EXPECT_EQ(prints[4].path.at(1), "leg1");
}

TEST(PathFigure, StaysInItsFrame) {
  for (const FigureSize layout : {FigureSize::wide, FigureSize::narrow})
    for (const double speed : {0.0, 0.001, 1.0, 100.0}) {
      motion::RecordedTrial recorded = tests::walk(30);
      for (std::size_t k = 0; k < 30; ++k)
        recorded.motion.com_m[k] =
            recorded.motion.com_start_m + (speed * static_cast<double>(k)) * Vec3{-0.7, 0.3, 0};
      const auto elements = tests::parse_xml(path_figure(recorded.robot, recorded.motion, layout));
      const double width = elements[0].number("width"), height = elements[0].number("height");
      for (const auto& [x, y] : tests::points(tests::with_class(elements, "path").at(0))) {
        EXPECT_GE(x, 0);
        EXPECT_LE(x, width);
        EXPECT_GE(y, 0);
        EXPECT_LE(y, height);
      }
      EXPECT_LT(tests::with_class(elements, "grid").size(), 2u);
      EXPECT_LT(elements.size(), 200u);
    }
}

TEST(PathFigure, TakesOneFrameAndAFootThatNeverTouches) {
  motion::RecordedTrial recorded = tests::walk(1);
  recorded.motion.touch[0].assign(1, false);
  const auto elements = tests::parse_xml(path_figure(recorded.robot, recorded.motion, FigureSize::narrow));
  EXPECT_TRUE(tests::with_class(elements, "footprint").empty());
  EXPECT_THAT(tests::texts(elements), Contains("0.05 m after 0.1 s"));
}

TEST(PathFigure, HasWhereCommandsLeadInPlaceOfTheStraightLine) {
  motion::RecordedTrial recorded = tests::walk(40);
  const auto frames = static_cast<std::size_t>(recorded.motion.frames());
  recorded.motion.command.assign(frames, {2.0f, 0.0f});
  const double way_m = 2.0 * recorded.motion.frame_s * static_cast<double>(frames);
  const auto path_m = motion::commanded_path_m(recorded.robot, recorded.motion);
  ASSERT_EQ(path_m.size(), frames + 1);
  const Vec3 moved = path_m.back() - path_m.front();
  EXPECT_NEAR(std::hypot(moved.x, moved.y), way_m, 1e-9);
  const auto elements = tests::parse_xml(path_figure(recorded.robot, recorded.motion, FigureSize::wide));
  const auto commanded = tests::with_class(elements, "beeline");
  ASSERT_EQ(commanded.size(), 1u);
  EXPECT_EQ(commanded[0].name, "polyline");
}

}  // namespace
}  // namespace amble::figures
