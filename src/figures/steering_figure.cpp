#include "amble/figures/steering_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/figures/axis.hpp"
#include "amble/figures/side_view.hpp"
#include "amble/figures/style_sheet.hpp"
#include "amble/figures/svg.hpp"

namespace amble::figures {
namespace {

constexpr double mean_s = 1.0;  ///< speed and turn are means over this long: within a stride a body sways

/// Speed along its own forward axis, m/s, and turn to the left, rad/s, frame by frame.
struct Rates {
  std::vector<double> speed, turn;
};

std::vector<double> headings_rad(const robot::RobotSpec& robot, const motion::Motion& motion) {
  std::vector<double> headings;
  for (const Quat& rotation : motion.root_rotation) {
    const Vec3 forward = rotate(rotation * conjugate(robot.bodies[0].rotation), {1.0, 0.0, 0.0});
    double heading = std::atan2(forward.y, forward.x);
    constexpr double turn = 2.0 * std::numbers::pi;
    if (!headings.empty()) heading += turn * std::round((headings.back() - heading) / turn);
    headings.push_back(heading);
  }
  return headings;
}

Rates rates_done(const robot::RobotSpec& robot, const motion::Motion& motion) {
  const std::vector<double> headings = headings_rad(robot, motion);
  const int last = motion.frames() - 1;
  const int half = std::max(1, static_cast<int>(std::lround(0.5 * mean_s / motion.frame_s)));
  Rates rates;
  for (int k = 0; k <= last; ++k) {
    const std::size_t from = to_index(std::max(0, k - half)), to = to_index(std::min(last, k + half));
    const double seconds = std::max(static_cast<double>(to - from), 1.0) * motion.frame_s;
    const Vec3 moved = motion.com_m[to] - motion.com_m[from];
    const double heading = headings[to_index(k)];
    rates.speed.push_back((moved.x * std::cos(heading) + moved.y * std::sin(heading)) / seconds);
    rates.turn.push_back((headings[to] - headings[from]) / seconds);
  }
  return rates;
}

/// Both paths, in metres to the right and up, a point for the start and one for each frame; and the robot.
struct Ground {
  std::vector<Point> told_m, done_m;
  std::vector<int> frames;                        ///< in which the robot is drawn
  std::vector<std::vector<Silhouette>> robots_m;  ///< from far to near, a robot for each of them
};

Ground seen_by(const robot::RobotSpec& robot, const motion::Motion& motion, const Camera& camera) {
  Ground ground;
  const auto project = [&](Vec3 at) { return Point{dot(at, camera.right), dot(at, camera.up)}; };
  for (const Vec3 at_m : motion::commanded_path_m(robot, motion)) ground.told_m.push_back(project(at_m));
  ground.done_m.push_back(project(motion.com_start_m));
  for (const Vec3 at_m : motion.com_m) ground.done_m.push_back(project(at_m));
  const int last = motion.frames() - 1;
  for (int i = 0; i < steering_poses; ++i) {
    const int frame = static_cast<int>(std::lround(static_cast<double>(last) * i / (steering_poses - 1)));
    if (!ground.frames.empty() && frame == ground.frames.back()) continue;
    ground.frames.push_back(frame);
    ground.robots_m.push_back(silhouettes(robot, motion::body_poses(robot, motion, frame), camera));
  }
  return ground;
}

struct Extents {
  Interval x, y;
};

Extents extents_of(const Ground& ground) {
  Extents extents{{ground.done_m[0].x, ground.done_m[0].x}, {ground.done_m[0].y, ground.done_m[0].y}};
  const auto include = [&](Point at, double around_m = 0.0) {
    for (const double side : {-around_m, around_m}) {
      extents.x = including(extents.x, at.x + side);
      extents.y = including(extents.y, at.y + side);
    }
  };
  for (const auto* path : {&ground.told_m, &ground.done_m})
    for (const Point at : *path) include(at);
  for (const auto& outlines : ground.robots_m)
    for (const Silhouette& outline : outlines) {
      include(outline.centre_m, outline.radius_m);
      for (const Point at : outline.corners_m) include(at);
    }
  return extents;
}

/// From above such that what is longer lies along the width.
Ground along_the_width(const robot::RobotSpec& robot, const motion::Motion& motion) {
  Ground ground = seen_by(robot, motion, top_camera(false));
  const Extents extents = extents_of(ground);
  return extents.x.length() >= extents.y.length() ? ground : seen_by(robot, motion, top_camera(true));
}

/// From metres to px.
struct GroundMap {
  Extents extents;
  double px_per_m, left_px, top_px;

  Point operator()(Point at) const {
    return {left_px + (at.x - extents.x.lower) * px_per_m, top_px + (extents.y.upper - at.y) * px_per_m};
  }
  double bottom_px() const { return top_px + extents.y.length() * px_per_m; }
};

GroundMap map_of(const Ground& ground, FigureSize layout) {
  constexpr double top_px = 34.0, most_px = 440.0, most_px_per_m = 260.0;
  const Extents extents = extents_of(ground);
  const double px_per_m = std::min({width_px(layout) / std::max(extents.x.length(), 1e-3),
                                    most_px / std::max(extents.y.length(), 1e-3), most_px_per_m});
  return {extents, px_per_m, 0.5 * (width_px(layout) - extents.x.length() * px_per_m), top_px};
}

/// Without corners closer than this to the one before.
std::vector<Point> drawn(const std::vector<Point>& corners_m, const GroundMap& map, double least_px) {
  std::vector<Point> kept;
  for (const Point at_m : corners_m)
    if (const Point at = map(at_m);
        kept.empty() || std::hypot(at.x - kept.back().x, at.y - kept.back().y) >= least_px)
      kept.push_back(at);
  return kept;
}

std::vector<Point> drawn_path(const std::vector<Point>& path_m, const GroundMap& map) {
  std::vector<Point> path = drawn(path_m, map, 2.0);
  path.push_back(map(path_m.back()));
  return path;
}

void draw_outlines(Svg& svg, const robot::RobotSpec& robot, const std::vector<Silhouette>& outlines,
                   const GroundMap& map) {
  svg.begin_group("far");
  for (const Silhouette& outline : outlines) {
    const int leg = robot.leg_of_body(robot.geoms[to_index(outline.geom)].body);
    const std::string look = leg < 0 ? "trunk" : "limb";
    svg.begin_group(leg < 0 ? "" : leg_class(leg));
    const std::vector<Point> corners = drawn(outline.corners_m, map, 2.5);
    if (corners.empty())
      svg.circle(map(outline.centre_m), outline.radius_m * map.px_per_m, look);
    else
      svg.polygon(corners, look);
    svg.end_group();
  }
  svg.end_group();
}

void draw_scale_bar(Svg& svg, double px_per_m, double right_px, double y_px) {
  const double most_px = std::min(240.0, 0.5 * right_px);  // beside the keys
  const double length_m = nice_ticks({0.0, most_px / px_per_m}, 2).step;
  const double left_px = right_px - length_m * px_per_m;
  svg.line({left_px, y_px}, {right_px, y_px}, "scale-bar");
  for (const double x : {left_px, right_px}) svg.line({x, y_px - 4}, {x, y_px + 4}, "scale-bar");
  svg.text({0.5 * (left_px + right_px), y_px - 8}, Anchor::middle, "tick", number(length_m) + " m");
}

void draw_keys(Svg& svg) {
  svg.line({0, 12}, {26, 12}, "told");
  svg.text({32, 16}, Anchor::start, "value", "told");
  svg.line({76, 12}, {102, 12}, "path");
  svg.text({108, 16}, Anchor::start, "value", "did");
}

/// Times above their places; one that would cover an earlier one goes below, then higher up, and so on.
void draw_times(Svg& svg, const motion::Motion& motion, const Ground& ground, const GroundMap& map,
                double width) {
  constexpr double half_width_px = 20.0, height_px = 13.0, beside_px = 9.0;
  std::vector<Point> taken;
  for (const int frame : ground.frames) {
    const Point here = map(ground.done_m[to_index(frame + 1)]);
    Point label{std::clamp(here.x, half_width_px, width - half_width_px), here.y - beside_px};
    const auto covers = [&](Point other) {
      return std::fabs(other.x - label.x) < 2.0 * half_width_px && std::fabs(other.y - label.y) < height_px;
    };
    for (int i = 0; i < 2 * steering_poses && std::ranges::any_of(taken, covers); ++i) {
      const int pair = i / 2;
      const double lines = 1.0 + pair;
      label.y = i % 2 == 0 ? here.y + beside_px + height_px * (lines - 0.3)
                           : here.y - beside_px - height_px * lines;
    }
    taken.push_back(label);
    svg.text(label, Anchor::middle, "label halo", fmt::format("{:.0f} s", motion.time_s(frame)));
  }
}

void draw_ground_plan(Svg& svg, const robot::RobotSpec& robot, const motion::Motion& motion,
                      const Ground& ground, const GroundMap& map, double width) {
  for (const auto& outlines : ground.robots_m) draw_outlines(svg, robot, outlines, map);
  svg.polyline(drawn_path(ground.told_m, map), "told");
  svg.polyline(drawn_path(ground.done_m, map), "path");
  for (const int frame : ground.frames) {
    svg.circle(map(ground.told_m[to_index(frame + 1)]), 4, "told-dot");
    svg.circle(map(ground.done_m[to_index(frame + 1)]), 4, "end");
  }
  draw_times(svg, motion, ground, map, width);
  draw_scale_bar(svg, map.px_per_m, width - 4, 18);
}

/// A diagram over time of one of the two commands.
struct Course {
  std::string_view title;
  std::size_t command;  ///< index in motion::Motion::command
  const std::vector<double>& done;
};

void draw_course(Svg& svg, const motion::Motion& motion, const Course& course, const Box& box) {
  Interval values{0.0, 0.0};
  for (const auto& command : motion.command)
    values = including(values, static_cast<double>(command[course.command]));
  for (const double value : course.done) values = including(values, value);
  if (values.length() < 0.1) values.upper = values.lower + 0.1;
  constexpr double labels_px = 44.0;
  const Scale y{values, box.bottom(), box.y};
  const Scale time{{0.0, motion.seconds()}, box.x + labels_px, box.right() - 14.0};
  svg.text({box.x, box.y - 14}, Anchor::start, "label", course.title);
  draw_y_axis(svg, y, nice_ticks(values, 5), time.lower_px, time.upper_px, "");
  draw_x_axis(svg, time, nice_ticks(time.data, 6), box.bottom(), " s");
  std::vector<Point> told, done;
  for (int k = 0; k < motion.frames(); ++k) {
    const double x = time(motion.time_s(k));
    const Point command{x, y(static_cast<double>(motion.command[to_index(k)][course.command]))};
    if (told.empty() || k + 1 == motion.frames() || told.back().y != command.y) {
      if (!told.empty()) told.push_back({x, told.back().y});
      told.push_back(command);
    }
    if (done.empty() || k + 1 == motion.frames() || x - done.back().x >= 1.5)
      done.push_back({x, y(course.done[to_index(k)])});
  }
  svg.polyline(told, "told");
  svg.polyline(done, "path");
}

}  // namespace

std::string steering_figure(const robot::RobotSpec& robot, const motion::Motion& motion,
                            std::string_view note, FigureSize layout) {
  AMBLE_CHECK(motion.frames() > 0 && !motion.command.empty(), "a robot that was told something has moved");
  const bool wide = layout == FigureSize::wide;
  const Ground ground = along_the_width(robot, motion);
  const GroundMap map = map_of(ground, layout);
  const Rates done = rates_done(robot, motion);
  const double width = width_px(layout), gap = 30.0, course_px = 130.0, title_px = 58.0, axis_px = 26.0;
  const double column = wide ? 0.5 * (width - gap) : width;
  const Box first{0.0, map.bottom_px() + title_px, column, course_px};
  const Box second = wide ? Box{column + gap, first.y, column, course_px}
                          : Box{0.0, first.bottom() + axis_px + title_px, column, course_px};
  const double height = second.bottom() + axis_px + (note.empty() ? 0.0 : 26.0);
  const Point told = ground.told_m.back(), at_last = ground.done_m.back();
  Svg svg(width, height,
          fmt::format("What the {} was told and what it did, from above and over time: after {:.0f} s it is "
                      "{:.1f} m from where it was told to be",
                      robot.name, motion.seconds(), std::hypot(told.x - at_last.x, told.y - at_last.y)));
  draw_ground_plan(svg, robot, motion, ground, map, width);
  draw_keys(svg);
  draw_course(svg, motion, {"Speed, m/s", 0, done.speed}, first);
  draw_course(svg, motion, {"Turn to the left, rad/s", 1, done.turn}, second);
  if (!note.empty()) svg.text({0, height - 6}, Anchor::start, "value", note);
  return svg.finish();
}

std::string steering_svg(const robot::RobotSpec& robot, const motion::Motion& motion, std::string_view note) {
  return standalone_svg(steering_figure(robot, motion, note, FigureSize::wide));
}

}  // namespace amble::figures
