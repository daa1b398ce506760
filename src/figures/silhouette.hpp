#pragma once

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

}  // namespace amble::figures
