#include "amble/figures/silhouette.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "amble/core/index.hpp"

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

}  // namespace amble::figures
