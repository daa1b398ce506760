#include "amble/figures/filmstrip_figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "tests/figures/xml.hpp"
#include "tests/motion/fixture.hpp"

namespace amble::figures {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Not;

TEST(FilmstripFrames, CoverTheLastTwoSeconds) {
  const auto frames = filmstrip_frames(tests::walk(100).motion);
  ASSERT_EQ(frames.size(), static_cast<std::size_t>(filmstrip_poses));
  EXPECT_EQ(frames.back(), 99);
  EXPECT_EQ(frames.front(), 79);
}

TEST(FilmstripFrames, LeaveOutTheLastSecondBeforeAFall) {
  motion::Motion motion = tests::walk(100).motion;
  motion.outcome = record::Outcome::fell;
  EXPECT_EQ(filmstrip_frames(motion).back(), 89);
  EXPECT_EQ(filmstrip_frames(motion).front(), 69);
}

TEST(FilmstripFrames, TakeAllOfAShortRecording) {
  EXPECT_THAT(filmstrip_frames(tests::walk(3).motion), ElementsAre(0, 1, 2));
  EXPECT_THAT(filmstrip_frames(tests::walk(1).motion), ElementsAre(0));
  motion::Motion fallen = tests::walk(15).motion;
  fallen.outcome = record::Outcome::fell;
  EXPECT_EQ(filmstrip_frames(fallen).back(), 14);
}

TEST(FilmstripFigure, FillsTheFeetThatTouch) {
  const motion::RecordedTrial recorded = tests::walk(60);
  std::size_t touching = 0;
  for (const int frame : filmstrip_frames(recorded.motion))
    for (const auto& touch : recorded.motion.touch) touching += touch[static_cast<std::size_t>(frame)];
  const auto elements = tests::parse_xml(filmstrip_figure(recorded.robot, recorded.motion, FigureSize::wide));
  EXPECT_EQ(tests::with_class(elements, "cell").size(), 10u);
  EXPECT_EQ(tests::with_class(elements, "foot-down").size(), touching);
  EXPECT_EQ(tests::with_class(elements, "foot").size(), 40 - touching);
  EXPECT_EQ(tests::with_class(elements, "limb").size(), 80u);
  EXPECT_EQ(tests::with_class(elements, "trunk").size(), 10u);
}

TEST(FilmstripFigure, PutsTheFeetOnTheGroundLine) {
  // The lowest point of a foot's sphere is at z = 1 − 0.9 − 0.1 = 0.
  const motion::RecordedTrial recorded = tests::walk(60);
  const auto elements = tests::parse_xml(filmstrip_figure(recorded.robot, recorded.motion, FigureSize::wide));
  const double ground = tests::with_class(elements, "ground").at(0).number("y");
  const auto foot = tests::with_class(elements, "foot-down").at(0);
  EXPECT_NEAR(foot.number("cy") + foot.number("r"), ground, 0.02);
}

TEST(FilmstripFigure, LightensTheLegsOfTheFarSide) {
  // It walks along x, so the camera looks to the left, and the left legs (0 and 2) are far.
  const motion::RecordedTrial recorded = tests::walk(60);
  const auto elements = tests::parse_xml(filmstrip_figure(recorded.robot, recorded.motion, FigureSize::wide));
  for (const auto& limb : tests::with_class(elements, "limb")) {
    const std::string group = limb.path.at(1);
    EXPECT_EQ(group == "leg0 far" || group == "leg2 far", group.ends_with("far")) << group;
    EXPECT_TRUE(group == "leg0 far" || group == "leg2 far" || group == "leg1" || group == "leg3") << group;
  }
}

TEST(FilmstripFigure, MarksTheGroundWithTheDistanceFromTheStart) {
  // Started at x = −10 m, it is 13 m on at 6 s and 12 m at 4 s.
  motion::RecordedTrial recorded = tests::walk(60);
  recorded.motion.com_start_m.x -= 10;
  const auto texts =
      tests::texts(tests::parse_xml(filmstrip_figure(recorded.robot, recorded.motion, FigureSize::wide)));
  EXPECT_THAT(texts, Contains("12.0 m"));
  EXPECT_THAT(texts, Contains("13.0 m"));
  EXPECT_THAT(texts, Contains("6.00 s"));
  EXPECT_THAT(texts, Not(Contains("3.0 m")));
}

TEST(FilmstripFigure, KeepsEveryShapeInItsCell) {
  motion::RecordedTrial recorded = tests::walk(60, 6);
  for (auto& angle : recorded.motion.angle_rad) std::fill(angle.begin(), angle.end(), 1.3f);
  for (const FigureSize layout : {FigureSize::wide, FigureSize::narrow}) {
    const auto elements = tests::parse_xml(filmstrip_figure(recorded.robot, recorded.motion, layout));
    tests::XmlElement cell;
    for (const auto& element : elements) {
      if (element.path.back() == "cell") cell = element;
      if (element.path.back() != "limb") continue;
      for (const auto& [x, y] : tests::points(element)) {
        EXPECT_GE(x, cell.number("x"));
        EXPECT_LE(x, cell.number("x") + cell.number("width"));
        EXPECT_GE(y, cell.number("y"));
      }
    }
  }
}

TEST(FilmstripFigure, TakesOneFrameAndOtherLegCounts) {
  for (const int legs : {1, 2, 6, 9}) {
    const motion::RecordedTrial recorded = tests::walk(1, legs);
    const auto elements =
        tests::parse_xml(filmstrip_figure(recorded.robot, recorded.motion, FigureSize::narrow));
    EXPECT_EQ(tests::with_class(elements, "cell").size(), 1u);
  }
}

using testing::HasSubstr;
using testing::Not;

std::size_t pictures(const std::string& svg) {
  std::size_t count = 0;
  for (const auto& element : tests::parse_xml(svg))
    count += element.attributes.contains("class") && element.attributes.at("class").starts_with("picture ");
  return count;
}

/// Length of what the filmstrip shows, s.
double strip_s(const motion::Motion& motion) {
  const auto frames = filmstrip_frames(motion);
  return (frames.back() - frames.front()) * motion.frame_s;
}

TEST(WalkAnimation, HasTwentyPicturesForEachSecondOfTheFilmstripOrOneForEachFrame) {
  const auto walk = tests::walk(150);
  motion::Motion motion = walk.motion;
  for (const double frame_s : {0.1, 0.025}) {
    motion.frame_s = frame_s;
    EXPECT_EQ(static_cast<double>(pictures(walk_animation(walk.robot, motion))),
              std::floor(strip_s(motion) * std::min(20.0, 1.0 / frame_s) + 1e-9) + 1.0);
  }
  EXPECT_EQ(pictures(walk_animation(walk.robot, tests::walk(1).motion)), 1u);
}

TEST(WalkAnimation, ShowsOnePictureAfterTheOtherAsFastAsItWas) {
  const auto walk = tests::walk(150);
  motion::Motion motion = walk.motion;
  for (const double frame_s : {0.1, 0.025}) {
    motion.frame_s = frame_s;
    const std::size_t count = pictures(walk_animation(walk.robot, motion));
    const double picture_s = std::max(0.05, frame_s), length_s = picture_s * static_cast<double>(count);
    const std::string style = animation_style(motion);
    EXPECT_THAT(style, HasSubstr(fmt::format("animation: show {:.3f}s step-end infinite", length_s)));
    EXPECT_THAT(style, HasSubstr(fmt::format(".p0 {{ animation-delay: -{:.3f}s }}", length_s)));
    EXPECT_THAT(style, HasSubstr(fmt::format(".p{} {{ animation-delay: -{:.3f}s }}", count - 1, picture_s)));
    EXPECT_THAT(style, Not(HasSubstr(fmt::format(".p{} ", count))));
  }
}

TEST(WalkAnimation, IsOnePoseForWhoeverWantsNoMotion) {
  EXPECT_THAT(
      animation_style(tests::walk(150).motion),
      HasSubstr(
          "(prefers-reduced-motion: reduce) { .picture { animation: none } .p0 { visibility: visible } }"));
}

}  // namespace

}  // namespace amble::figures
