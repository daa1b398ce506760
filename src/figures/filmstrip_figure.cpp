#include "amble/figures/filmstrip_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/figures/side_view.hpp"
#include "amble/figures/svg.hpp"

namespace amble::figures {

namespace {

constexpr double strip_s = 2.0;
constexpr double fall_s = 1.0;

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

}  // namespace amble::figures
