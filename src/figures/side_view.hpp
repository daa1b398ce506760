#pragma once

#include <span>
#include <vector>

#include "amble/figures/silhouette.hpp"
#include "amble/figures/svg.hpp"
#include "amble/motion/motion.hpp"
#include "amble/robot/spec.hpp"

namespace amble::figures {

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
