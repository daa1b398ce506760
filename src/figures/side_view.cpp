#include "amble/figures/side_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/figures/axis.hpp"
#include "amble/figures/figure_size.hpp"
#include "amble/robot/pose.hpp"

namespace amble::figures {
namespace {

/// Corners of the polygon that approximates a circle.
constexpr int circle_corners = 20;

Point project(Vec3 at, const Camera& camera) {
  return {dot(at, camera.right), dot(at, camera.up)};
}

/// Points, in the geom's frame, whose projections have the geom's outline as their hull.
std::vector<Vec3> outline_points(const robot::Geom& geom) {
  if (geom.shape == robot::Shape::mesh) return geom.vertices_m;
  std::vector<Vec3> points;
  const Vec3 size = geom.size_m;
  if (geom.shape == robot::Shape::box) {
    for (const double x : {-size.x, size.x})
      for (const double y : {-size.y, size.y})
        for (const double z : {-size.z, size.z}) points.push_back({x, y, z});
  } else {
    for (int i = 0; i < circle_corners; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / circle_corners;
      for (const double z : {-size.y, size.y})
        points.push_back({size.x * std::cos(angle), size.x * std::sin(angle), z});
    }
  }
  return points;
}

/// A capsule is the hull of two spheres, whose projections are circles.
std::vector<Point> capsule_points(const robot::Geom& geom, Vec3 centre_m, Quat rotation,
                                  const Camera& camera) {
  std::vector<Point> points;
  for (const double z : {-geom.size_m.y, geom.size_m.y}) {
    const Point end = project(centre_m + rotate(rotation, {0.0, 0.0, z}), camera);
    for (int i = 0; i < circle_corners; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / circle_corners;
      points.push_back({end.x + geom.size_m.x * std::cos(angle), end.y + geom.size_m.x * std::sin(angle)});
    }
  }
  return points;
}

Silhouette silhouette(const robot::Geom& geom, const std::vector<robot::Pose>& poses, const Camera& camera) {
  const Vec3 centre_m = robot::centre_m(geom, poses);
  const Quat rotation = poses[to_index(geom.body)].rotation * geom.rotation;
  Silhouette result;
  result.centre_m = project(centre_m, camera);
  result.depth_m = dot(centre_m, camera.away);
  if (geom.shape == robot::Shape::sphere) {
    result.radius_m = geom.size_m.x;
  } else if (geom.shape == robot::Shape::capsule) {
    result.corners_m = convex_hull(capsule_points(geom, centre_m, rotation, camera));
  } else {
    std::vector<Point> points;
    for (const Vec3 at : outline_points(geom))
      points.push_back(project(centre_m + rotate(rotation, at), camera));
    result.corners_m = convex_hull(std::move(points));
  }
  return result;
}

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

Camera top_camera(bool x_up) {
  if (x_up) return {{0.0, -1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}};
  return {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, -1.0}};
}

Camera side_camera(Vec3 heading) {
  constexpr Vec3 up{0.0, 0.0, 1.0};
  return {heading, up, cross(up, heading)};
}

Vec3 mean_heading(const motion::Motion& motion, int first, int last) {
  const auto a = to_index(first), b = to_index(last);
  Vec3 way = motion.com_m[b] - motion.com_m[a];
  way.z = 0.0;
  constexpr double hardly_m = 0.05;
  if (norm(way) < hardly_m) {
    way = {};
    for (std::size_t k = a; k <= b; ++k) way = way + rotate(motion.root_rotation[k], {1.0, 0.0, 0.0});
    way.z = 0.0;
  }
  const double length = norm(way);
  return length > 0.0 ? (1.0 / length) * way : Vec3{1.0, 0.0, 0.0};
}

std::vector<Silhouette> silhouettes(const robot::RobotSpec& robot, const std::vector<robot::Pose>& poses,
                                    const Camera& camera) {
  std::vector<Silhouette> outlines;
  for (std::size_t g = 0; g < robot.geoms.size(); ++g) {
    outlines.push_back(silhouette(robot.geoms[g], poses, camera));
    outlines.back().geom = static_cast<int>(g);
  }
  std::ranges::stable_sort(outlines,
                           [](const Silhouette& a, const Silhouette& b) { return a.depth_m > b.depth_m; });
  return outlines;
}

// Andrew's monotone chain: the lower chain from left to right, then the upper one back.
std::vector<Point> convex_hull(std::vector<Point> points) {
  std::ranges::sort(points, [](Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Point> hull;
  const auto extend = [&hull](Point next, std::size_t keep) {
    const auto turns_left = [&] {
      const Point a = hull[hull.size() - 2], b = hull.back();
      return (b.x - a.x) * (next.y - a.y) - (b.y - a.y) * (next.x - a.x) > 0.0;
    };
    while (hull.size() >= keep + 2 && !turns_left()) hull.pop_back();
    hull.push_back(next);
  };
  for (const Point point : points) extend(point, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto point = points.rbegin() + 1; point != points.rend(); ++point) extend(*point, lower);
  hull.pop_back();
  return hull;
}

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
    const robot::Geom& geom = robot.geoms[to_index(outline.geom)];
    if (geom.rgba == robot::gone_rgba) continue;
    const int leg = robot.leg_of_body(geom.body);
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
