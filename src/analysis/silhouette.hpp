#pragma once

#include <vector>

#include "amble/analysis/motion.hpp"
#include "amble/analysis/svg.hpp"
#include "amble/robot/pose.hpp"
#include "amble/robot/spec.hpp"

namespace amble::analysis {

/// A parallel projection. Unit vectors in the world, at right angles to each other.
struct Camera {
  Vec3 right, up;  ///< what points to the right and up in the picture
  Vec3 away;       ///< where the camera looks
};

/// From above, with world x to the right and y up in the picture; or, turned, with x up and y to the left.
Camera top_camera(bool x_up);

/// Horizontally, at right angles to a horizontal heading, from the right-hand side of one who goes that way:
/// who does so walks to the right in the picture.
Camera side_camera(Vec3 heading);

/// Unit vector of the way the robot went between two frames, over the ground; where it hardly moved, of the
/// way it faced.
Vec3 mean_heading(const Motion& motion, int first, int last);

/// The outline of one geom in a camera's picture: metres to the right and up. Convex, counter-clockwise. A
/// sphere is a circle and has no corners.
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

}  // namespace amble::analysis
