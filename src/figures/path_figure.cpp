#include "amble/figures/path_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/figures/axis.hpp"
#include "amble/figures/side_view.hpp"
#include "amble/figures/svg.hpp"
#include "amble/motion/footfalls.hpp"
#include "amble/robot/legs.hpp"
#include "amble/robot/pose.hpp"

namespace amble::figures {
namespace {

struct Footprint {
  int leg;
  Point at_m;
};

/// Everything in the figure, in metres to the right and up.
struct Scene {
  std::vector<Point> path_m;
  std::vector<Point> commanded_m;  ///< where commands lead; empty without
  std::vector<Footprint> footprints;
  std::vector<std::vector<Point>> trunk_m;  ///< outlines of its geoms, at the start and at the end
};

/// The trunk's geoms as seen from above.
void add_trunk(const robot::RobotSpec& robot, const motion::Motion& motion, int frame, const Camera& camera,
               Scene& scene) {
  for (Silhouette& outline : silhouettes(robot, motion::body_poses(robot, motion, frame), camera))
    if (robot.leg_of_body(robot.geoms[to_index(outline.geom)].body) < 0)
      scene.trunk_m.push_back(std::move(outline.corners_m));
}

Scene make_scene(const robot::RobotSpec& robot, const motion::Motion& motion, const Camera& camera) {
  Scene scene;
  const auto project = [&](Vec3 at) { return Point{dot(at, camera.right), dot(at, camera.up)}; };
  scene.path_m.push_back(project(motion.com_start_m));
  for (const Vec3 com_m : motion.com_m) scene.path_m.push_back(project(com_m));
  for (const Vec3 at_m : motion::commanded_path_m(robot, motion)) scene.commanded_m.push_back(project(at_m));
  for (std::size_t leg = 0; leg < robot.legs.size(); ++leg)
    for (const int frame : motion::touchdown_frames(motion.touch[leg]))
      scene.footprints.push_back(
          {static_cast<int>(leg),
           project(robot::foot_m(robot, robot.legs[leg], motion::body_poses(robot, motion, frame)))});
  for (const int frame : {0, motion.frames() - 1}) add_trunk(robot, motion, frame, camera, scene);
  return scene;
}

/// The mapping from metres to px.
struct Map {
  Interval x_m, y_m;
  double px_per_m, left_px, top_px;

  Point operator()(Point at) const {
    return {left_px + (at.x - x_m.lower) * px_per_m, top_px + (y_m.upper - at.y) * px_per_m};
  }
  double bottom_px() const { return top_px + y_m.length() * px_per_m; }
};

Map make_map(const Scene& scene, FigureSize layout) {
  const bool wide = layout == FigureSize::wide;
  Interval x{scene.path_m[0].x, scene.path_m[0].x}, y{scene.path_m[0].y, scene.path_m[0].y};
  const auto include = [&](Point at) {
    x = including(x, at.x);
    y = including(y, at.y);
  };
  for (const Point at : scene.path_m) include(at);
  for (const Point at : scene.commanded_m) include(at);
  for (const Footprint& print : scene.footprints) include(print.at_m);
  for (const auto& trunk : scene.trunk_m)
    for (const Point at : trunk) include(at);
  const double room_px = width_px(layout) - 32, most_px = wide ? 480 : 600, magnified = wide ? 260 : 200;
  const double px_per_m =
      std::min({room_px / std::max(x.length(), 1e-3), most_px / std::max(y.length(), 1e-3), magnified});
  return {x, y, px_per_m, 0.5 * (width_px(layout) - x.length() * px_per_m), 34};
}

/// The path without corners closer than half a pixel.
std::vector<Point> thinned(const std::vector<Point>& path_m, const Map& map) {
  std::vector<Point> kept;
  for (const Point at_m : path_m) {
    const Point at = map(at_m);
    if (kept.empty() || std::hypot(at.x - kept.back().x, at.y - kept.back().y) >= 0.5) kept.push_back(at);
  }
  kept.push_back(map(path_m.back()));
  return kept;
}

void draw_grid(Svg& svg, const Map& map, double width, double height, double step_m) {
  const double left_m = map.x_m.lower - map.left_px / map.px_per_m, right_m = left_m + width / map.px_per_m;
  const double top_m = map.y_m.upper + map.top_px / map.px_per_m, bottom_m = top_m - height / map.px_per_m;
  svg.begin_group("grid");
  for (double k = std::ceil(left_m / step_m); k * step_m <= right_m; ++k) {
    const double x = map({k * step_m, 0.0}).x;
    svg.line({x, 0}, {x, height});
  }
  for (double k = std::ceil(bottom_m / step_m); k * step_m <= top_m; ++k) {
    const double y = map({0.0, k * step_m}).y;
    svg.line({0, y}, {width, y});
  }
  svg.end_group();
}

void draw_scale_bar(Svg& svg, const Map& map, double right, double y, double step_m) {
  const double left = right - step_m * map.px_per_m;
  svg.line({left, y}, {right, y}, "scale-bar");
  svg.line({left, y - 4}, {left, y + 4}, "scale-bar");
  svg.line({right, y - 4}, {right, y + 4}, "scale-bar");
  svg.text({0.5 * (left + right), y - 8}, Anchor::middle, "tick", number(step_m) + " m");
}

void draw_ends(Svg& svg, const Map& map, const Scene& scene, const motion::Summary& summary, double width) {
  const Point start = map(scene.path_m.front()), end = map(scene.path_m.back());
  // For a robot that was told where to go, that way in place of the straight line.
  if (scene.commanded_m.empty())
    svg.line(start, end, "beeline");
  else
    svg.polyline(thinned(scene.commanded_m, map), "zoomed beeline");
  svg.circle(start, 5, "start");
  svg.circle(end, 5, "end");
  const auto name = [&](Point at, double below, const std::string& text) {
    const double half = 3.8 * static_cast<double>(text.size());
    svg.text({std::clamp(at.x, half, width - half), at.y + below}, Anchor::middle, "label halo", text);
  };
  // One label above its point, the other below, so that they do not overlap.
  name(start, start.y < end.y ? -14 : 24, "start");
  name(end, start.y < end.y ? 24 : -14,
       fmt::format("{:.2f} m after {:.1f} s", summary.distance_m, summary.seconds));
}

}  // namespace

std::string path_figure(const robot::RobotSpec& robot, const motion::Motion& motion, FigureSize layout) {
  AMBLE_CHECK(motion.frames() > 0, "a recording of a walk has a frame");
  const Scene scene = make_scene(robot, motion, top_camera(layout == FigureSize::narrow));
  const motion::Summary summary = motion::summarise(motion);
  const Map map = make_map(scene, layout);
  const double width = width_px(layout), height = map.bottom_px() + 62;
  const double step_m = nice_ticks({0.0, width / map.px_per_m}, layout == FigureSize::wide ? 12 : 6).step;

  Svg svg(width, height, fmt::format("Path seen from above: {:.2f} m from start to end", summary.distance_m));
  draw_grid(svg, map, width, height, step_m);
  for (const auto& trunk : scene.trunk_m) {
    std::vector<Point> corners(trunk.size());
    std::ranges::transform(trunk, corners.begin(), map);
    svg.polygon(corners, "trunk-outline");
  }
  for (const Footprint& print : scene.footprints) {
    svg.begin_group(leg_class(print.leg));
    svg.circle(map(print.at_m), 3.2, "footprint");
    svg.end_group();
  }
  svg.polyline(thinned(scene.path_m, map), "path");
  draw_ends(svg, map, scene, summary, width);
  draw_scale_bar(svg, map, width - 16, height - 16, step_m);
  return svg.finish();
}

}  // namespace amble::figures
