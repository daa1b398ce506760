#include "amble/figures/steering_figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/figures/xml.hpp"
#include "tests/motion/fixture.hpp"

namespace amble::figures {
namespace steering_figure_test {

using testing::IsSupersetOf;

/// A robot that walks and turns as it is told, but for a share `slower`: 30 s of 0.5 m/s and `turn_rad_s`.
motion::RecordedTrial circling(double turn_rad_s, double slower = 1.0) {
  motion::RecordedTrial walk = tests::walk(300);
  motion::Motion& motion = walk.motion;
  for (int k = 0; k < motion.frames(); ++k) {
    const double heading = turn_rad_s * slower * motion.time_s(k);
    const auto at = static_cast<std::size_t>(k);
    const double radius = turn_rad_s == 0.0 ? 0.0 : 0.5 / turn_rad_s;
    motion.com_m[at] = motion.com_start_m +
                       (turn_rad_s == 0.0 ? Vec3{0.5 * slower * motion.time_s(k), 0.0, 0.0}
                                          : radius * Vec3{std::sin(heading), 1.0 - std::cos(heading), 0.0});
    motion.root_m[at] = motion.com_m[at];
    motion.root_rotation[at] = {std::cos(0.5 * heading), 0.0, 0.0, std::sin(0.5 * heading)};
  }
  motion.command.assign(300, {0.5f, static_cast<float>(turn_rad_s)});
  return walk;
}

std::vector<tests::XmlElement> drawn(const motion::RecordedTrial& walk,
                                     FigureSize layout = FigureSize::wide) {
  return tests::parse_xml(steering_figure(walk.robot, walk.motion, "a note", layout));
}

/// Lines of one class: the path, speed and turn.
std::vector<std::vector<std::pair<double, double>>> lines(const std::vector<tests::XmlElement>& elements,
                                                          const std::string& css_class) {
  std::vector<std::vector<std::pair<double, double>>> found;
  for (const tests::XmlElement& element : tests::with_class(elements, css_class))
    if (element.name == "polyline") found.push_back(tests::points(element));
  return found;
}

double apart(std::pair<double, double> a, std::pair<double, double> b) {
  return std::hypot(a.first - b.first, a.second - b.second);
}

TEST(SteeringFigure, LaysOneUponTheOtherWhereItDidWhatItWasTold) {
  const auto elements = drawn(circling(0.3));
  const auto told = lines(elements, "told"), done = lines(elements, "path");
  ASSERT_EQ(told.size(), 3u);
  ASSERT_EQ(done.size(), 3u);
  for (const auto& at : done[0]) {
    double nearest = 1e9;
    for (const auto& other : told[0]) nearest = std::min(nearest, apart(at, other));
    EXPECT_LT(nearest, 4.0);
  }
  EXPECT_LT(apart(told[0].back(), done[0].back()), 8.0) << "frames are 0.1 s long";
  for (const std::size_t course : {1u, 2u})
    for (std::size_t i = 8; i + 8 < done[course].size(); ++i)
      EXPECT_NEAR(done[course][i].second, told[course].front().second, 2.0) << course;
}

TEST(SteeringFigure, ShowsWhoLagsBehind) {
  const auto elements = drawn(circling(0.3, 0.5));
  const auto told = lines(elements, "told"), done = lines(elements, "path");
  EXPECT_GT(apart(told[0].back(), done[0].back()), 50.0);
  const double middle = done[2][done[2].size() / 2].second;
  EXPECT_GT(middle, told[2].front().second + 10.0) << "it turns less";
  EXPECT_THAT(elements.front().attributes.at("aria-label"),
              testing::HasSubstr("from where it was told to be"));
}

TEST(SteeringFigure, LiesAlongTheWidthWhicheverWayItGoes) {
  const motion::RecordedTrial along_x = circling(0.0);
  motion::RecordedTrial along_y = along_x;
  for (Vec3& at : along_y.motion.com_m)
    at = along_x.motion.com_start_m + Vec3{0.0, at.x - along_x.motion.com_start_m.x, 0.0};
  along_y.motion.root_m = along_y.motion.com_m;
  along_y.motion.command.assign(300, {0.0f, 0.0f});
  for (const motion::RecordedTrial& walk : {along_x, along_y}) {
    const auto path = lines(drawn(walk), "path").at(0);
    EXPECT_GT(std::fabs(path.back().first - path.front().first), 800.0);
    EXPECT_LT(std::fabs(path.back().second - path.front().second), 1.0);
  }
}

TEST(SteeringFigure, ShowsTheRobotAtSevenTimesWhoseNamesDoNotCoverEachOther) {
  motion::RecordedTrial still = circling(0.0, 0.0);
  for (const auto& walk : {circling(0.3), still}) {
    const auto elements = drawn(walk);
    const auto names = tests::with_class(elements, "halo");
    ASSERT_EQ(names.size(), static_cast<std::size_t>(steering_poses));
    EXPECT_EQ(tests::with_class(elements, "told-dot").size(), names.size());
    for (std::size_t i = 0; i < names.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_TRUE(std::fabs(names[i].number("x") - names[k].number("x")) >= 40.0 ||
                    std::fabs(names[i].number("y") - names[k].number("y")) >= 12.0)
            << names[i].text << " and " << names[k].text;
  }
}

TEST(SteeringFigure, StaysInItsFrameAndSaysTheNote) {
  for (const double turn : {0.0, 0.3, -1.0})
    for (const FigureSize layout : {FigureSize::wide, FigureSize::narrow}) {
      const auto elements = drawn(circling(turn), layout);
      const double width = elements.front().number("width"), height = elements.front().number("height");
      EXPECT_EQ(width, width_px(layout));
      for (const auto& shape : elements)
        if (shape.attributes.contains("points"))
          for (const auto& [x, y] : tests::points(shape)) {
            EXPECT_GE(x, -1.0);
            EXPECT_LE(x, width + 1.0);
            EXPECT_GE(y, -1.0);
            EXPECT_LE(y, height + 1.0);
          }
      EXPECT_THAT(tests::texts(elements),
                  IsSupersetOf({"told", "did", "Speed, m/s", "Turn to the left, rad/s", "a note"}));
    }
}

TEST(SteeringFigure, TakesAWalkOfOneFrame) {
  motion::RecordedTrial walk = tests::walk(1);
  walk.motion.command.assign(1, {0.0f, 0.0f});
  drawn(walk);
}

}  // namespace steering_figure_test
}  // namespace amble::figures
