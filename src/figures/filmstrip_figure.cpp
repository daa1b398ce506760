#include "amble/figures/filmstrip_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/figures/silhouette.hpp"
#include "amble/graphics/axis.hpp"
#include "amble/graphics/svg.hpp"
#include "amble/robot/pose.hpp"

namespace amble::figures {
namespace {

using namespace graphics;

constexpr double strip_s = 2.0;
constexpr double fall_s = 1.0;

/// One pose, projected.
struct Picture {
  int frame = 0;
  double camera_m = 0.0;    ///< along the heading: the middle of the cell
  double distance_m = 0.0;  ///< of `camera_m` from the start of the walk, along the heading
  std::vector<Silhouette> outlines;
};

/// A cell of the strip and its mapping from metres to px.
struct Cell {
  Box box;
  double ground_px, px_per_m;

  Point operator()(Point at_m, const Picture& picture) const {
    return {box.x + 0.5 * box.width + (at_m.x - picture.camera_m) * px_per_m, ground_px - at_m.y * px_per_m};
  }
};

/// The camera moves at the robot's mean velocity, so that the swaying of the trunk remains visible.
std::vector<Picture> take_pictures(const robot::RobotSpec& robot, const motion::Motion& motion) {
  const std::vector<int> frames = filmstrip_frames(motion);
  const Camera camera = side_camera(mean_heading(motion, frames.front(), frames.back()));
  const auto along_m = [&](int frame) { return dot(motion.com_m[to_index(frame)], camera.right); };
  const double first_m = along_m(frames.front()), last_m = along_m(frames.back());
  const double start_m = dot(motion.com_start_m, camera.right);
  std::vector<Picture> pictures;
  for (const int frame : frames) {
    const int span = std::max(1, frames.back() - frames.front());
    const double share = static_cast<double>(frame - frames.front()) / span;
    const double camera_m = first_m + share * (last_m - first_m);
    pictures.push_back({frame, camera_m, camera_m - start_m,
                        silhouettes(robot, motion::body_poses(robot, motion, frame), camera)});
  }
  return pictures;
}

/// The extent of all poses: half their width about the camera, and their height above the ground, m.
struct Extent {
  double half_width_m = 0.1, height_m = 0.1;
};

Extent extent_of(const std::vector<Picture>& pictures) {
  Extent extent;
  for (const Picture& picture : pictures)
    for (const Silhouette& outline : picture.outlines) {
      const auto include = [&](double x_m, double y_m) {
        extent.half_width_m = std::max(extent.half_width_m, std::abs(x_m - picture.camera_m));
        extent.height_m = std::max(extent.height_m, y_m);
      };
      include(outline.centre_m.x - outline.radius_m, outline.centre_m.y + outline.radius_m);
      include(outline.centre_m.x + outline.radius_m, outline.centre_m.y);
      for (const Point corner : outline.corners_m) include(corner.x, corner.y);
    }
  return extent;
}

/// Coarse marks labelled with the distance, and four fine ones between them.
void draw_ground(Svg& svg, const Picture& picture, const Cell& cell) {
  svg.rect({cell.box.x, cell.ground_px, cell.box.width, cell.box.bottom() - cell.ground_px}, "ground");
  svg.line({cell.box.x, cell.ground_px}, {cell.box.right(), cell.ground_px}, "ground-line");
  const double width_m = cell.box.width / cell.px_per_m;
  const Ticks coarse = nice_ticks({0.0, width_m}, 5);
  const double left_m = picture.distance_m - 0.5 * width_m, fine_m = 0.2 * coarse.step;
  for (double k = std::ceil(left_m / fine_m); k * fine_m <= left_m + width_m; ++k) {
    const double x = cell.box.x + (k * fine_m - left_m) * cell.px_per_m;
    const bool is_coarse = std::fmod(k, 5.0) == 0.0;
    svg.line({x, cell.ground_px}, {x, cell.ground_px + (is_coarse ? 7 : 3.5)}, "ground-line");
    const bool room = x > cell.box.x + 16 && x < cell.box.right() - 16;
    if (is_coarse && room)
      svg.text({x, cell.ground_px + 19}, Anchor::middle, "tiny", label(k * fine_m, coarse.decimals) + " m");
  }
}

/// Mean depth of a leg's geoms, away from the camera.
double leg_depth_m(const robot::RobotSpec& robot, const Picture& picture, int leg) {
  double sum = 0.0;
  int count = 0;
  for (const Silhouette& outline : picture.outlines)
    if (robot.leg_of_body(robot.geoms[to_index(outline.geom)].body) == leg) {
      sum += outline.depth_m;
      ++count;
    }
  return count > 0 ? sum / count : 0.0;
}

void draw_outline(Svg& svg, const Silhouette& outline, const Picture& picture, const Cell& cell,
                  const char* css_class) {
  if (outline.corners_m.empty()) {
    svg.circle(cell(outline.centre_m, picture), outline.radius_m * cell.px_per_m, css_class);
    return;
  }
  std::vector<Point> corners;
  for (const Point corner : outline.corners_m) corners.push_back(cell(corner, picture));
  svg.polygon(corners, css_class);
}

void draw_robot(Svg& svg, const robot::RobotSpec& robot, const motion::Motion& motion, const Picture& picture,
                const Cell& cell) {
  double middle_m = 0.0;
  std::vector<double> depth_m;
  for (int leg = 0; leg < static_cast<int>(robot.legs.size()); ++leg) {
    depth_m.push_back(leg_depth_m(robot, picture, leg));
    middle_m += depth_m.back() / static_cast<double>(robot.legs.size());
  }
  for (const Silhouette& outline : picture.outlines) {
    const int leg = robot.leg_of_body(robot.geoms[to_index(outline.geom)].body);
    if (leg < 0) {
      draw_outline(svg, outline, picture, cell, "trunk");
      continue;
    }
    const auto l = to_index(leg);
    const bool foot = robot.legs[l].foot_geom == outline.geom;
    const bool touching = foot && motion.touch[l][to_index(picture.frame)];
    svg.begin_group(leg_class(leg) + (depth_m[l] > middle_m ? " far" : ""));
    draw_outline(svg, outline, picture, cell, touching ? "foot-down" : foot ? "foot" : "limb");
    svg.end_group();
  }
}

}  // namespace

std::vector<int> filmstrip_frames(const motion::Motion& motion) {
  double end_s = motion.seconds();
  if (motion.outcome != record::Outcome::completed)
    end_s = std::max(end_s - fall_s, std::min(end_s, strip_s));
  const int last = std::clamp(static_cast<int>(std::lround(end_s / motion.frame_s)), 1, motion.frames()) - 1;
  const int first = static_cast<int>(std::lround(std::max(0.0, last - strip_s / motion.frame_s)));
  std::vector<int> frames;
  for (int i = 0; i < filmstrip_poses; ++i) {
    const int frame =
        first + static_cast<int>(std::lround(static_cast<double>(last - first) * i / (filmstrip_poses - 1)));
    if (frames.empty() || frame != frames.back()) frames.push_back(frame);
  }
  return frames;
}

std::string filmstrip_figure(const robot::RobotSpec& robot, const motion::Motion& motion, Layout layout) {
  AMBLE_CHECK(motion.frames() > 0, "a recording of a walk has a frame");
  const bool wide = layout == Layout::wide;
  const std::vector<Picture> pictures = take_pictures(robot, motion);
  const Extent extent = extent_of(pictures);
  const int columns = wide ? 5 : 2;
  const double gap = wide ? 10 : 8, head_px = 26, foot_px = 26;
  const double cell_width = (width_px(layout) - (columns - 1) * gap) / columns;
  const double px_per_m = std::min((cell_width - 12) / (2.0 * extent.half_width_m), 180.0 / extent.height_m);
  const double cell_height = head_px + extent.height_m * px_per_m + foot_px;
  const int rows = (static_cast<int>(pictures.size()) + columns - 1) / columns;

  Svg svg(
      width_px(layout), rows * (cell_height + gap) - gap,
      fmt::format("Side views of the {} at {} times, from {:.2f} s to {:.2f} s", robot.name, pictures.size(),
                  motion.time_s(pictures.front().frame), motion.time_s(pictures.back().frame)));
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const int row = static_cast<int>(i) / columns, column = static_cast<int>(i) % columns;
    const Box box{column * (cell_width + gap), row * (cell_height + gap), cell_width, cell_height};
    const Cell cell{box, box.bottom() - foot_px, px_per_m};
    svg.rect(box, "cell");
    draw_ground(svg, pictures[i], cell);
    draw_robot(svg, robot, motion, pictures[i], cell);
    svg.text({box.x + 9, box.y + 17}, Anchor::start, "tick",
             fmt::format("{:.2f} s", motion.time_s(pictures[i].frame)));
  }
  return svg.finish();
}

}  // namespace amble::figures
