#include "amble/figures/filmstrip_figure.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <vector>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/figures/side_view.hpp"
#include "amble/figures/svg.hpp"

namespace amble::figures {
namespace {

constexpr double strip_s = 2.0;
constexpr double fall_s = 1.0;

constexpr double scene_width_px = 640, scene_height_px = 250, foot_px = 26, head_px = 10;

/// Time from one picture to the next, s: a frame at least.
double interval_s(const motion::Motion& motion) {
  return std::max(1.0 / most_pictures_per_s, motion.frame_s);
}

/// Evenly spaced frames over the time of the filmstrip.
std::vector<int> animation_frames(const motion::Motion& motion) {
  const std::vector<int> strip = filmstrip_frames(motion);
  const double step = interval_s(motion) / motion.frame_s;
  std::vector<int> frames;
  for (double frame = strip.front(); frame <= strip.back(); frame += step)
    frames.push_back(static_cast<int>(std::lround(frame)));
  return frames;
}

}  // namespace

std::vector<int> filmstrip_frames(const motion::Motion& motion) {
  double end_s = motion.seconds();
  if (motion.outcome != record::Outcome::completed)
    end_s = std::max(end_s - fall_s, std::min(end_s, strip_s));
  const int last = std::clamp(static_cast<int>(std::lround(end_s / motion.frame_s)), 1, motion.frames()) - 1;
  const int first = static_cast<int>(std::lround(std::max(0.0, last - strip_s / motion.frame_s)));
  std::vector<int> frames;
  for (int i = 0; i < filmstrip_poses; ++i) {
    const int frame =
        first + static_cast<int>(std::lround(static_cast<double>(last - first) * i / (filmstrip_poses - 1)));
    if (frames.empty() || frame != frames.back()) frames.push_back(frame);
  }
  return frames;
}

std::string filmstrip_figure(const robot::RobotSpec& robot, const motion::Motion& motion, FigureSize layout) {
  AMBLE_CHECK(motion.frames() > 0, "a recording of a walk has a frame");
  const bool wide = layout == FigureSize::wide;
  const std::vector<SideView> views = side_views(robot, motion, filmstrip_frames(motion));
  const Extent extent = extent_of(views);
  const int columns = wide ? 5 : 2;
  const double gap = wide ? 10 : 8, head_px = 26, foot_px = 26;
  const double cell_width = (width_px(layout) - (columns - 1) * gap) / columns;
  const double px_per_m = std::min((cell_width - 12) / (2.0 * extent.half_width_m), 180.0 / extent.height_m);
  const double cell_height = head_px + extent.height_m * px_per_m + foot_px;
  const int rows = (static_cast<int>(views.size()) + columns - 1) / columns;

  Svg svg(width_px(layout), rows * (cell_height + gap) - gap,
          fmt::format("Side views of the {} at {} times, from {:.2f} s to {:.2f} s", robot.name, views.size(),
                      motion.time_s(views.front().frame), motion.time_s(views.back().frame)));
  for (std::size_t i = 0; i < views.size(); ++i) {
    const int row = static_cast<int>(i) / columns, column = static_cast<int>(i) % columns;
    const Box box{column * (cell_width + gap), row * (cell_height + gap), cell_width, cell_height};
    const ViewCell cell{box, box.bottom() - foot_px, px_per_m};
    svg.rect(box, "cell");
    draw_ground(svg, views[i], cell);
    draw_robot(svg, robot, motion, views[i], cell);
    svg.text({box.x + 9, box.y + 17}, Anchor::start, "tick",
             fmt::format("{:.2f} s", motion.time_s(views[i].frame)));
  }
  return svg.finish();
}

std::string walk_animation(const robot::RobotSpec& robot, const motion::Motion& motion) {
  AMBLE_CHECK(motion.frames() > 0, "a recording of a walk has a frame");
  const std::vector<SideView> views = side_views(robot, motion, animation_frames(motion));
  const Extent extent = extent_of(views);
  const double room_px = scene_height_px - foot_px - head_px;
  const double px_per_m =
      std::min((scene_width_px - 12) / (2.0 * extent.half_width_m), room_px / extent.height_m);
  const ViewCell cell{{0, 0, scene_width_px, scene_height_px}, scene_height_px - foot_px, px_per_m};
  Svg svg(scene_width_px, scene_height_px,
          fmt::format("The {} walking, seen from the side, {:.2f} s to {:.2f} s", robot.name,
                      motion.time_s(views.front().frame), motion.time_s(views.back().frame)));
  svg.rect(cell.box, "cell");
  for (std::size_t i = 0; i < views.size(); ++i) {
    svg.begin_group(fmt::format("picture p{}", i));
    draw_ground(svg, views[i], cell);
    draw_robot(svg, robot, motion, views[i], cell);
    svg.end_group();
  }
  return svg.finish();
}

std::string animation_style(const motion::Motion& motion) {
  const std::size_t count = animation_frames(motion).size();
  const double length_s = static_cast<double>(count) * interval_s(motion);
  // A delay in the past: each picture is where it is in the cycle from the start.
  std::string style = fmt::format(
      "@keyframes show {{ 0% {{ visibility: visible }} {:.3f}% {{ visibility: hidden }} }}\n"
      ".picture {{ visibility: hidden; animation: show {:.3f}s step-end infinite }}\n",
      100.0 / static_cast<double>(count), length_s);
  for (std::size_t i = 0; i < count; ++i)
    style += fmt::format(".p{} {{ animation-delay: {:.3f}s }}\n", i,
                         static_cast<double>(i) * interval_s(motion) - length_s);
  return style +
         "@media (prefers-reduced-motion: reduce) { .picture { animation: none } .p0 { visibility: visible } "
         "}\n";
}

}  // namespace amble::figures
