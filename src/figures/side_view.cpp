#include "amble/figures/side_view.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/figures/axis.hpp"
#include "amble/figures/figure_size.hpp"
#include "amble/robot/pose.hpp"

namespace amble::figures {

namespace {

/// Mean depth of a leg's geoms, away from the camera.
double leg_depth_m(const robot::RobotSpec& robot, const SideView& view, int leg) {
  double sum = 0.0;
  int count = 0;
  for (const Silhouette& outline : view.outlines)
    if (robot.leg_of_body(robot.geoms[to_index(outline.geom)].body) == leg) {
      sum += outline.depth_m;
      ++count;
    }
  return count > 0 ? sum / count : 0.0;
}

void draw_outline(Svg& svg, const Silhouette& outline, const SideView& view, const ViewCell& cell,
                  const char* css_class) {
  if (outline.corners_m.empty()) {
    svg.circle(cell(outline.centre_m, view), outline.radius_m * cell.px_per_m, css_class);
    return;
  }
  std::vector<Point> corners;
  for (const Point corner : outline.corners_m) corners.push_back(cell(corner, view));
  svg.polygon(corners, css_class);
}

}  // namespace

std::vector<SideView> side_views(const robot::RobotSpec& robot, const motion::Motion& motion,
                                 std::span<const int> frames) {
  AMBLE_CHECK(!frames.empty(), "a view is of a frame");
  const Camera camera = side_camera(mean_heading(motion, frames.front(), frames.back()));
  const auto along_m = [&](int frame) { return dot(motion.com_m[to_index(frame)], camera.right); };
  const double first_m = along_m(frames.front()), last_m = along_m(frames.back());
  const double start_m = dot(motion.com_start_m, camera.right);
  std::vector<SideView> views;
  for (const int frame : frames) {
    const int span = std::max(1, frames.back() - frames.front());
    const double share = static_cast<double>(frame - frames.front()) / span;
    const double camera_m = first_m + share * (last_m - first_m);
    views.push_back({frame, camera_m, camera_m - start_m,
                     silhouettes(robot, motion::body_poses(robot, motion, frame), camera)});
  }
  return views;
}

Extent extent_of(std::span<const SideView> views) {
  Extent extent;
  for (const SideView& view : views)
    for (const Silhouette& outline : view.outlines) {
      const auto include = [&](double x_m, double y_m) {
        extent.half_width_m = std::max(extent.half_width_m, std::abs(x_m - view.camera_m));
        extent.height_m = std::max(extent.height_m, y_m);
      };
      include(outline.centre_m.x - outline.radius_m, outline.centre_m.y + outline.radius_m);
      include(outline.centre_m.x + outline.radius_m, outline.centre_m.y);
      for (const Point corner : outline.corners_m) include(corner.x, corner.y);
    }
  return extent;
}

void draw_ground(Svg& svg, const SideView& view, const ViewCell& cell) {
  svg.rect({cell.box.x, cell.ground_px, cell.box.width, cell.box.bottom() - cell.ground_px}, "ground");
  svg.line({cell.box.x, cell.ground_px}, {cell.box.right(), cell.ground_px}, "ground-line");
  const double width_m = cell.box.width / cell.px_per_m;
  const Ticks coarse = nice_ticks({0.0, width_m}, 5);
  const double left_m = view.distance_m - 0.5 * width_m, fine_m = 0.2 * coarse.step;
  for (double k = std::ceil(left_m / fine_m); k * fine_m <= left_m + width_m; ++k) {
    const double x = cell.box.x + (k * fine_m - left_m) * cell.px_per_m;
    const bool is_coarse = std::fmod(k, 5.0) == 0.0;
    svg.line({x, cell.ground_px}, {x, cell.ground_px + (is_coarse ? 7 : 3.5)}, "ground-line");
    const bool room = x > cell.box.x + 16 && x < cell.box.right() - 16;
    if (is_coarse && room)
      svg.text({x, cell.ground_px + 19}, Anchor::middle, "tiny", label(k * fine_m, coarse.decimals) + " m");
  }
}

void draw_robot(Svg& svg, const robot::RobotSpec& robot, const motion::Motion& motion, const SideView& view,
                const ViewCell& cell) {
  double middle_m = 0.0;
  std::vector<double> depth_m;
  for (int leg = 0; leg < static_cast<int>(robot.legs.size()); ++leg) {
    depth_m.push_back(leg_depth_m(robot, view, leg));
    middle_m += depth_m.back() / static_cast<double>(robot.legs.size());
  }
  for (const Silhouette& outline : view.outlines) {
    const int leg = robot.leg_of_body(robot.geoms[to_index(outline.geom)].body);
    if (leg < 0) {
      draw_outline(svg, outline, view, cell, "trunk");
      continue;
    }
    const auto l = to_index(leg);
    const bool foot = robot.legs[l].has_foot_geom(outline.geom);
    const bool touching = foot && motion.touch[l][to_index(view.frame)];
    svg.begin_group(leg_class(leg) + (depth_m[l] > middle_m ? " far" : ""));
    draw_outline(svg, outline, view, cell, touching ? "foot-down" : foot ? "foot" : "limb");
    svg.end_group();
  }
}

}  // namespace amble::figures
