#include "amble/figures/walk_animation.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "amble/figures/filmstrip_figure.hpp"
#include "tests/figures/xml.hpp"
#include "tests/motion/fixture.hpp"

namespace amble::figures {
namespace {

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
