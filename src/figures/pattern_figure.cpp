#include "amble/figures/pattern_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>

#include "amble/core/index.hpp"
#include "amble/figures/axis.hpp"
#include "amble/figures/style_sheet.hpp"
#include "amble/figures/svg.hpp"
#include "amble/motion/footfalls.hpp"

namespace amble::figures {
namespace {

constexpr double left_px = 44.0;
constexpr double top_px = 34.0;
constexpr double bottom_px = 26.0;
/// Width of the last bin, beyond the end of the cycle: triggers while the timer was stopped.
constexpr double idle_px = 12.0;

double degrees(double angle_rad) {
  return angle_rad * 180.0 / std::numbers::pi;
}

struct Grid {
  bool wide;
  std::size_t legs, types;
  double column_gap_px, row_gap_px, cell_height_px, strip_height_px;

  double cell_width() const {
    const auto n = static_cast<double>(legs);
    return (width_px(wide ? FigureSize::wide : FigureSize::narrow) - left_px - (n - 1) * column_gap_px - 2) /
           n;
  }
  double left(std::size_t leg) const {
    return left_px + static_cast<double>(leg) * (cell_width() + column_gap_px);
  }
  double top(std::size_t type) const {
    return top_px + 36 + static_cast<double>(type) * (cell_height_px + row_gap_px);
  }
  double strip_bottom() const { return top(types) + strip_height_px; }
  double height(bool with_triggers) const {
    return (with_triggers ? strip_bottom() : top(types) - row_gap_px + 8) + bottom_px;
  }
  Scale time(std::size_t leg, const motion::SupgPatterns& supg) const {
    return {{0.0, supg.period_s()}, left(leg), left(leg) + cell_width() - idle_px};
  }
};

Grid make_grid(const robot::RobotSpec& robot, FigureSize layout) {
  const bool wide = layout == FigureSize::wide;
  return {wide,
          robot.legs.size(),
          robot.joint_types.size(),
          wide ? 24.0 : 8.0,
          wide ? 40. : 38.,
          wide ? 104.0 : 76.0,
          wide ? 44.0 : 36.0};
}

/// The joint of that type; none if the leg has none.
std::optional<std::size_t> joint_index(const robot::RobotSpec& robot, std::size_t leg, std::size_t type) {
  const int joint = robot.legs[leg].joints[type];
  return joint < 0 ? std::nullopt : std::optional(to_index(joint));
}

/// Degrees: the range of all joints of a type and their patterns.
Interval row_range(const robot::RobotSpec& robot, const motion::SupgPatterns& supg, std::size_t type) {
  std::optional<Interval> range;
  const auto include = [&](double angle_rad) {
    const double angle = degrees(angle_rad);
    range = range ? including(*range, angle) : Interval{angle, angle};
  };
  for (std::size_t leg = 0; leg < robot.legs.size(); ++leg) {
    const auto joint = joint_index(robot, leg, type);
    if (!joint) continue;
    include(robot.joints[*joint].command_range().lower_rad);
    include(robot.joints[*joint].command_range().upper_rad);
    for (const double angle_rad : supg.patterns_rad[*joint]) include(angle_rad);
  }
  if (!range) return {0.0, 1.0};
  if (range->length() <= 0.0) range->upper = range->lower + 1.0;
  return *range;
}

std::vector<Point> pattern_points(const motion::SupgPatterns& supg, std::size_t joint, const Scale& time,
                                  const Scale& angle) {
  std::vector<Point> points;
  for (std::size_t tick = 0; tick < supg.patterns_rad[joint].size(); ++tick)
    points.push_back(
        {time(static_cast<double>(tick) * supg.timestep_s), angle(degrees(supg.patterns_rad[joint][tick]))});
  return points;
}

void draw_cell(Svg& svg, const robot::RobotSpec& robot, const motion::SupgPatterns& supg, const Grid& grid,
               std::size_t leg, std::size_t type, const Scale& angle) {
  const Scale time = grid.time(leg, supg);
  const auto own = joint_index(robot, leg, type);
  if (!own) return;
  const robot::AngleRange command = robot.joints[*own].command_range();
  const double upper = angle(degrees(command.upper_rad)), lower = angle(degrees(command.lower_rad));
  svg.rect({time.lower_px, upper, time.upper_px - time.lower_px, lower - upper}, "range", 2);
  for (const double tick : nice_ticks(angle.data, 5).values)
    svg.line({time.lower_px, angle(tick)}, {time.upper_px, angle(tick)}, tick == 0.0 ? "axis" : "grid");
  // The other legs in grey, for comparison.
  for (std::size_t other = 0; other < robot.legs.size(); ++other)
    if (const auto joint = joint_index(robot, other, type); joint && other != leg)
      svg.polyline(pattern_points(supg, *joint, time, angle), "ghost");
  const double start = time(supg.offset_ticks[leg] * supg.timestep_s);
  svg.line({start, angle.upper_px}, {start, angle.lower_px}, "offset");
  svg.polyline(pattern_points(supg, *own, time, angle), "curve");
}

void draw_row(Svg& svg, const robot::RobotSpec& robot, const motion::SupgPatterns& supg, const Grid& grid,
              std::size_t type) {
  const Scale angle{row_range(robot, supg, type), grid.top(type) + grid.cell_height_px, grid.top(type)};
  svg.text({0, grid.top(type) - 11}, Anchor::start, "title", robot.joint_types[type]);
  const Ticks ticks = nice_ticks(angle.data, 5);
  for (const double tick : ticks.values)
    svg.text({left_px - 6, angle(tick) + 4}, Anchor::end, "tick", label(tick, ticks.decimals) + "°");
  for (std::size_t leg = 0; leg < robot.legs.size(); ++leg) {
    svg.begin_group(leg_class(static_cast<int>(leg)));
    draw_cell(svg, robot, supg, grid, leg, type, angle);
    svg.end_group();
  }
}

/// Number of triggers by the timer's value; the last element counts those while it was stopped.
std::vector<int> trigger_histogram(const motion::SupgPatterns& supg, const motion::Motion& motion,
                                   std::size_t leg, int bins) {
  std::vector<int> counts(to_index(bins) + 1);
  for (const auto& ticks : motion::timer_at_triggers(motion.trigger[leg], motion.timer_ticks[leg])) {
    const int bin =
        ticks ? std::clamp(static_cast<int>(*ticks * bins / supg.period_ticks), 0, bins - 1) : bins;
    ++counts[to_index(bin)];
  }
  return counts;
}

void draw_time_axis(Svg& svg, const motion::SupgPatterns& supg, const Grid& grid, std::size_t leg,
                    double base_px) {
  const Scale time = grid.time(leg, supg);
  draw_x_axis(svg, time, nice_ticks(time.data, grid.wide ? 5 : 2), base_px, " s");
}

void draw_strip(Svg& svg, const motion::SupgPatterns& supg, const Grid& grid, std::size_t leg,
                const std::vector<int>& counts, int highest) {
  const Scale time = grid.time(leg, supg);
  const double base = grid.strip_bottom();
  const double bin_px = (time.upper_px - time.lower_px) / static_cast<double>(counts.size() - 1);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == 0) continue;
    const double height = counts[i] * grid.strip_height_px / highest;
    const bool idle = i + 1 == counts.size();
    const double left = idle ? time.upper_px + 4 : time.lower_px + static_cast<double>(i) * bin_px + 0.5;
    svg.rect({left, base - height, idle ? idle_px - 5 : std::max(bin_px - 1, 1.0), height}, "stance", 1);
  }
  const double start = time(supg.offset_ticks[leg] * supg.timestep_s);
  svg.line({start, base - grid.strip_height_px}, {start, base}, "offset");
  if (std::ranges::max(counts) == 0)
    svg.text({time.lower_px + 4, base - 6}, Anchor::start, "tick", grid.wide ? "no trigger" : "none");
  draw_time_axis(svg, supg, grid, leg, base);
}

void draw_triggers(Svg& svg, const robot::RobotSpec& robot, const motion::SupgPatterns& supg,
                   const motion::Motion& motion, const Grid& grid) {
  const int bins = grid.wide ? 25 : 20;
  std::vector<std::vector<int>> counts;
  int highest = 1;
  for (std::size_t leg = 0; leg < robot.legs.size(); ++leg) {
    counts.push_back(trigger_histogram(supg, motion, leg, bins));
    highest = std::max(highest, std::ranges::max(counts.back()));
  }
  svg.text({0, grid.top(grid.types) - 11}, Anchor::start, "title",
           grid.wide ? "Timer when a trigger reset it" : "Timer when reset");
  svg.text({left_px - 6, grid.top(grid.types) + 8}, Anchor::end, "tick", fmt::format("{}×", highest));
  for (std::size_t leg = 0; leg < robot.legs.size(); ++leg) {
    svg.begin_group(leg_class(static_cast<int>(leg)));
    draw_strip(svg, supg, grid, leg, counts[leg], highest);
    svg.end_group();
  }
}

}  // namespace

std::string pattern_figure(const robot::RobotSpec& robot, const motion::SupgPatterns& supg,
                           const motion::Motion& motion, FigureSize layout) {
  const Grid grid = make_grid(robot, layout);
  const bool triggers = !motion.trigger.empty() && !motion.timer_ticks.empty();
  Svg svg(width_px(layout), grid.height(triggers),
          fmt::format("Temporal patterns of {} joints over a cycle of {} s", robot.joints.size(),
                      number(supg.period_s())));
  for (std::size_t leg = 0; leg < robot.legs.size(); ++leg) {
    svg.begin_group(leg_class(static_cast<int>(leg)));
    svg.rect({grid.left(leg), 4, grid.cell_width() - idle_px, 4}, "stance", 2);
    svg.text({grid.left(leg), 26}, Anchor::start, "label", robot.legs[leg].name);
    svg.end_group();
  }
  for (std::size_t type = 0; type < robot.joint_types.size(); ++type) draw_row(svg, robot, supg, grid, type);
  if (triggers) {
    draw_triggers(svg, robot, supg, motion, grid);
  } else {
    for (std::size_t leg = 0; leg < robot.legs.size(); ++leg)
      draw_time_axis(svg, supg, grid, leg, grid.height(triggers) - bottom_px);
  }
  return svg.finish();
}

std::string pattern_svg(const robot::RobotSpec& robot, const motion::SupgPatterns& supg) {
  return standalone_svg(pattern_figure(robot, supg, {}, FigureSize::wide));
}

}  // namespace amble::figures
