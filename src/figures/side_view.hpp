#pragma once

#include <span>
#include <vector>

#include "amble/figures/svg.hpp"
#include "amble/motion/motion.hpp"
#include "amble/robot/pose.hpp"
#include "amble/robot/spec.hpp"

namespace amble::figures {

/// A parallel projection. Unit vectors in the world, at right angles to each other.
struct Camera {
  Vec3 right, up;  ///< to the right and up in the picture
  Vec3 away;       ///< the viewing direction
};

/// From above, with world x to the right and y up in the picture; or, turned, with x up and y to the left.
Camera top_camera(bool x_up);

/// Looks horizontally, at right angles to a horizontal heading, from its right-hand side: the heading points
/// to the right in the picture.
Camera side_camera(Vec3 heading);

/// Unit vector of the robot's displacement over the ground between two frames; if it hardly moved, of the
/// direction it faced.
Vec3 mean_heading(const motion::Motion& motion, int first, int last);

/// The outline of one geom in a camera's picture, metres to the right and up: a convex polygon,
/// counter-clockwise. A sphere is a circle and has no corners.
struct Silhouette {
  int geom = 0;
  std::vector<Point> corners_m;
  Point centre_m;
  double radius_m = 0.0;  ///< of a sphere
  double depth_m = 0.0;   ///< of the centre, away from the camera
};

/// Outlines of all geoms, from far to near.
std::vector<Silhouette> silhouettes(const robot::RobotSpec& robot, const std::vector<robot::Pose>& poses,
                                    const Camera& camera);

/// Convex hull, counter-clockwise (y up), without collinear corners.
std::vector<Point> convex_hull(std::vector<Point> points);

/// One pose seen from the side, projected.
struct SideView {
  int frame = 0;
  double camera_m = 0.0;    ///< along the heading: the middle of the cell
  double distance_m = 0.0;  ///< of `camera_m` from the start of the walk, along the heading
  std::vector<Silhouette> outlines;
};

/// The robot in these frames (at least one). The camera moves at its mean velocity, so that the swaying of
/// the trunk remains visible.
std::vector<SideView> side_views(const robot::RobotSpec& robot, const motion::Motion& motion,
                                 std::span<const int> frames);

/// The extent of all poses: half their width about the camera, and their height above the ground, m.
struct Extent {
  double half_width_m = 0.1, height_m = 0.1;
};
Extent extent_of(std::span<const SideView> views);

/// Where a view is drawn, and its mapping from metres to px.
struct ViewCell {
  Box box;
  double ground_px, px_per_m;

  Point operator()(Point at_m, const SideView& view) const {
    return {box.x + 0.5 * box.width + (at_m.x - view.camera_m) * px_per_m, ground_px - at_m.y * px_per_m};
  }
};

/// Coarse marks labelled with the distance, and four fine ones between them.
void draw_ground(figures::Svg& svg, const SideView& view, const ViewCell& cell);

/// Legs on the far side are lighter; a foot on the ground is filled.
void draw_robot(figures::Svg& svg, const robot::RobotSpec& robot, const motion::Motion& motion,
                const SideView& view, const ViewCell& cell);

}  // namespace amble::figures
