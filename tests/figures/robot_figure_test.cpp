#include "amble/figures/robot_figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "amble/core/math.hpp"
#include "tests/figures/xml.hpp"
#include "tests/robot/legged.hpp"

namespace amble::figures {
namespace {

using testing::Contains;

TEST(RobotFigure, ShowsEachShapeFromThreeSidesAndNamesEachLeg) {
  const robot::RobotSpec robot = tests::legged_robot(3);
  const auto elements = tests::parse_xml(robot_figure(robot));
  std::size_t shapes = 0;
  for (const auto& element : elements) shapes += element.name == "polygon" || element.name == "circle";
  EXPECT_EQ(shapes, 3 * robot.geoms.size());
  const auto texts = tests::texts(elements);
  for (const robot::Leg& leg : robot.legs) EXPECT_THAT(texts, Contains(leg.name));
  for (const char* view : {"from its right", "from the front", "from above"})
    EXPECT_THAT(texts, Contains(view));
}

TEST(RobotFigure, HasAllViewsAtTheScaleThatItsBarStates) {
  robot::RobotSpec robot = tests::legged_robot(2);
  const auto pixels_of_a_metre = [&](double size) {
    for (robot::Geom& geom : robot.geoms) geom.size_m = size * geom.size_m;
    const auto elements = tests::parse_xml(robot_figure(robot));
    const auto bar = tests::with_class(elements, "scale-bar").at(0);
    for (const std::string& text : tests::texts(elements))
      if (text.ends_with(" m")) return (bar.number("x2") - bar.number("x1")) / std::stod(text);
    return 0.0;
  };
  const double before = pixels_of_a_metre(1.0);
  EXPECT_GT(before, 0.0);
  EXPECT_LT(pixels_of_a_metre(100.0), 0.2 * before) << "all of it is in the picture";
}

}  // namespace
}  // namespace amble::figures
