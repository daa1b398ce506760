#include "amble/figures/footfall_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "amble/core/check.hpp"
#include "amble/figures/axis.hpp"
#include "amble/figures/svg.hpp"
#include "amble/motion/footfalls.hpp"

namespace amble::figures {
namespace {

constexpr double zoom_s = 4.0;
constexpr double label_width_px = 40.0;

/// Sizes of one of the two diagrams.
struct Rows {
  double top_px, bar_px, pitch_px;
  double mark_px;  ///< size of a trigger's mark

  double bar_top(std::size_t leg) const { return top_px + static_cast<double>(leg) * pitch_px; }
  double bottom(std::size_t legs) const { return bar_top(legs) - (pitch_px - bar_px) + 8; }
};

void draw_bars(Svg& svg, const std::vector<bool>& touch, double frame_s, const Scale& time, double top_px,
               double height_px) {
  for (const motion::Stance& stance : motion::stances(touch, frame_s)) {
    const double start = std::max(stance.start_s, time.data.lower),
                 end = std::min(stance.end_s, time.data.upper);
    if (end <= start) continue;
    svg.rect({time(start), top_px, std::max(time(end) - time(start), 0.5), height_px}, "stance", 1.5);
  }
}

void draw_triggers(Svg& svg, const std::vector<bool>& trigger, double frame_s, const Scale& time,
                   const Rows& rows, double bar_top) {
  const double size = rows.mark_px;
  for (const double at_s : motion::trigger_times_s(trigger, frame_s)) {
    if (at_s < time.data.lower || at_s > time.data.upper) continue;
    const double x = time(at_s), tip = bar_top - 1.0;
    svg.polygon(std::array<Point, 3>{{{x - size, tip - 1.5 * size}, {x + size, tip - 1.5 * size}, {x, tip}}},
                "trigger");
  }
}

void draw_rows(Svg& svg, const robot::RobotSpec& robot, const motion::Motion& motion, const Scale& time,
               const Rows& rows, bool with_share) {
  for (std::size_t leg = 0; leg < robot.legs.size(); ++leg) {
    const double top = rows.bar_top(leg), middle = top + 0.5 * rows.bar_px + 4.5;
    svg.begin_group(leg_class(static_cast<int>(leg)));
    svg.rect({0, top, 4, rows.bar_px}, "stance", 2);
    svg.text({11, middle}, Anchor::start, "label", robot.legs[leg].name);
    svg.rect({time.lower_px, top, time.upper_px - time.lower_px, rows.bar_px}, "track", 1.5);
    draw_bars(svg, motion.touch[leg], motion.frame_s, time, top, rows.bar_px);
    if (!motion.trigger.empty()) draw_triggers(svg, motion.trigger[leg], motion.frame_s, time, rows, top);
    if (with_share)
      svg.text({time.upper_px + 12, middle}, Anchor::start, "value",
               fmt::format("{:.0f} %", 100.0 * motion::contact_share(motion.touch[leg])));
    svg.end_group();
  }
}

/// Lines from the last seconds in the upper diagram to the lower one.
void draw_zoom_guides(Svg& svg, const Scale& whole, const Scale& part, double upper_top, double upper_bottom,
                      double lower_top) {
  const double left = whole(part.data.lower), right = whole.upper_px;
  svg.rect({left, upper_top, right - left, upper_bottom - upper_top}, "zoomed", 3);
  svg.polygon(std::array<Point, 4>{{{left, upper_bottom},
                                    {right, upper_bottom},
                                    {part.upper_px, lower_top},
                                    {part.lower_px, lower_top}}},
              "zoom-beam");
}

}  // namespace

std::string footfall_figure(const robot::RobotSpec& robot, const motion::Motion& motion, FigureSize layout) {
  AMBLE_CHECK(motion.frames() > 0, "a recording of a walk has a frame");
  const bool wide = layout == FigureSize::wide;
  const double width = width_px(layout), right = width - 56;
  const std::size_t legs = robot.legs.size();
  const bool zoom = motion.seconds() > 1.5 * zoom_s;
  const Scale whole{{0.0, motion.seconds()}, label_width_px, right};
  const Rows upper{42, wide ? 16.0 : 13.0, wide ? 28.0 : 24.0, wide ? 3.0 : 2.0};
  const double upper_bottom = upper.bottom(legs);
  const Rows lower{upper_bottom + (wide ? 92 : 84), wide ? 24.0 : 18.0, wide ? 40.0 : 32.0, wide ? 4.5 : 3.5};
  const double height = (zoom ? lower.bottom(legs) : upper_bottom) + 26;

  Svg svg(width, height,
          fmt::format("Footfall diagram of {:.1f} s: when each foot was on the ground", motion.seconds()));
  const Scale part{{std::max(0.0, motion.seconds() - zoom_s), motion.seconds()}, label_width_px, right};
  if (zoom) draw_zoom_guides(svg, whole, part, upper.top_px - 9, upper_bottom, lower.top_px - 14);
  svg.text({right + 12, 20}, Anchor::start, "tick", "on the");
  svg.text({right + 12, 34}, Anchor::start, "tick", "ground");
  draw_rows(svg, robot, motion, whole, upper, true);
  draw_x_axis(svg, whole, nice_ticks(whole.data, wide ? 16 : 6), upper_bottom, " s");
  if (zoom) {
    draw_rows(svg, robot, motion, part, lower, false);
    draw_x_axis(svg, part, nice_ticks(part.data, wide ? 10 : 5), lower.bottom(legs), " s");
  }
  return svg.finish();
}

}  // namespace amble::figures
